// A plot of a table: curves or bars of named columns, drawn by Python's matplotlib or by a page's script.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/frontend/table/table.h"

namespace dmpc::apps {

/// Style of a series: computed values are a line from left to right, reference values are points, and distributions are a box
/// with a line in it and whiskers.
enum class PlotMark : std::uint8_t { line, points, bars, bands };

/// Number of styles that colour-blind people can distinguish: eight colours, then the first four of them again, dashed or
/// hatched.
inline constexpr std::size_t plot_color_count = 12;

struct PlotSeries {
  std::string title;   ///< in the legend
  std::string column;  ///< name of a column of numbers
  PlotMark mark = PlotMark::line;
  std::size_t color = 0;                    ///< below plot_color_count; each has its own shape of points, too
  std::string low = {}, high = {};          ///< ends of the whiskers of bands: columns
  std::string box_low = {}, box_high = {};  ///< ends of the box of bands: columns; `column` is the line in it
};

enum class PlotScale : std::uint8_t { linear, powers_of_10 };

struct PlotAxis {
  std::string label;  ///< with its unit, unless the ticks have it: for bytes, bytes/s, KiB and times
  PlotScale scale = PlotScale::linear;
  std::optional<double> least = std::nullopt, most = std::nullopt;  ///< limits of the axis; nothing: those of the drawn values
};

/// Either all series are bars or bands, or none is.
struct Plot {
  std::string name;  ///< file name without an extension
  std::string title;
  /// The column along x; for bars, that whose texts name the positions.
  std::string place;
  PlotAxis x, y;
  std::vector<PlotSeries> series;
  std::optional<double> bar_width = {};  ///< width of bars at numbers along x, each to the right of its number
  bool is_stacked = false;               ///< stacked bars, the first at the bottom
};

/// Returns a plot of series over one column.
Plot curves(std::string name, std::string title, std::string place, PlotAxis x, PlotAxis y, std::vector<PlotSeries> series);
/// Returns a plot with one or several bars for each node, by the column `node`: side by side, or stacked.
Plot bars_by_node(std::string name, std::string title, PlotAxis y, std::vector<PlotSeries> series, bool is_stacked = false);
/// Returns a plot in which all columns except the first are stacked.
Plot stacked_by_node(std::string name, std::string title, PlotAxis y, const std::vector<Column>& columns);
/// An axis for percent from 0.
PlotAxis percent_axis(const std::string& what);

}  // namespace dmpc::apps
