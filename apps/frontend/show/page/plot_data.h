// A plot or a map of numbers as a page has it, for its script (plot.js) to draw.
#pragma once

#include <optional>
#include <string>

#include "apps/frontend/show/page/number_map.h"
#include "apps/frontend/table/plot.h"
#include "apps/frontend/table/table.h"

namespace dmpc::apps::html {

/// Returns JSON; nothing if no row of the table is drawn. Keys:
///
/// - title, bars, stacked, width (of bars along x; 0: they stand at places)
/// - x, y: {label, unit, digits, log, least, most, ticks: [[position, text]]}; places: names along x in place of limits and ticks
/// - series: [{name, color, mark, unit, digits, rows}]; a row: x, or the number of its place, y, and for intervals and bands the
///   two ends, for bands also those of the box
std::optional<std::string> plot_data(const Plot& plot, const Table& table);

/// Maps of more numbers have them in 255ths of the largest.
inline constexpr std::size_t exact_numbers_max = 4096;

/// Returns JSON. Requires rows * columns numbers, at least one. Keys:
///
/// - title, row_label, column_label, value_label, rows, columns, most
/// - ticks: of the scale; column_ticks: of time, in columns, and column_ms: their length, if these are time
/// - values, or levels: base64 of a byte for each number, in 255ths of `most`, rounded up
std::string map_data(const NumberMap& map);

}  // namespace dmpc::apps::html
