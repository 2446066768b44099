// A picture of a table: curves or bars of named columns, drawn by gnuplot from the table's CSV file.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/frontend/table/table.h"

namespace dmpc::apps {

/// How a series is drawn: what was computed as a line from left to right, what it is held against as points, what is uncertain as
/// hollow points with an interval; how something is spread out as a box with a line in it, and lines beyond it to the ends.
enum class PlotMark : std::uint8_t { line, points, bars, intervals, bands };

/// Looks that people who are colour-blind can tell apart: eight colours, then the first four of them again, dashed or hatched.
inline constexpr std::size_t plot_color_count = 12;

/// The colours as #rrggbb. All but black are legible on white and on black; a dark page turns black into white.
extern const std::array<const char*, 8> plot_colors;

/// One column, or those of its rows that are meant.
struct PlotSeries {
  std::string title;   ///< in the legend
  std::string column;  ///< by its name; of numbers
  /// Only rows with each of these texts in the column named before it.
  std::vector<std::pair<std::string, std::string>> where = {};
  PlotMark mark = PlotMark::line;
  std::size_t color = 0;                    ///< below plot_color_count; each has a shape of its points, too
  std::string low = {}, high = {};          ///< intervals and bands: the columns of both ends
  std::string box_low = {}, box_high = {};  ///< bands: of the ends of the box; `column` is the line in it
};

enum class PlotScale : std::uint8_t { linear, powers_of_2, powers_of_10 };

struct PlotAxis {
  std::string label;  ///< with its unit, unless the ticks name that: of bytes, bytes/s, KiB and times
  PlotScale scale = PlotScale::linear;
  std::optional<double> least = std::nullopt, most = std::nullopt;  ///< nothing: as the figures ask for
};

/// large: a file of its own. small: part of a page, legible on a telephone, with the legend below, and as high as that needs.
enum class PlotSize : std::uint8_t { large, small };

/// What is drawn. The series are all bars or bands, or none is.
struct Plot {
  std::string name;  ///< file name without an extension
  std::string title;
  /// The column along x. For bars the columns whose texts, one after the other, name a place; series with the same name stand
  /// side by side there.
  std::vector<std::string> places;
  PlotAxis x, y;
  std::vector<PlotSeries> series;
  std::optional<double> bar_width = {};  ///< width of bars at numbers along x, each to the right of its number
  bool is_stacked = false;               ///< bars upon one another, the first at the bottom
  PlotSize size = PlotSize::large;
};

/// Series over one column.
Plot curves(std::string name, std::string title, std::string place, PlotAxis x, PlotAxis y, std::vector<PlotSeries> series);
/// A bar or several for each node, by the column `node`: side by side, or upon one another.
Plot bars_by_node(std::string name, std::string title, PlotAxis y, std::vector<PlotSeries> series, bool is_stacked = false);
/// All columns but the first upon one another.
Plot stacked_by_node(std::string name, std::string title, PlotAxis y, const std::vector<Column>& columns);
/// Numbers of nodes, and percent from 0.
PlotAxis node_axis();
PlotAxis percent_axis(const std::string& what);

/// A gnuplot script that reads the table's CSV file, `data_file`, in the folder in which it is run, and writes NAME.svg there;
/// nothing if no row of the table is drawn. Expects columns that the table has.
std::optional<std::string> script_of(const Plot& plot, const Table& table, const std::string& data_file);

}  // namespace dmpc::apps
