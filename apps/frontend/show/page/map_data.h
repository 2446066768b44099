// A map of numbers as a page has it, for its script (plot.js) to draw.
#pragma once

#include <cstddef>
#include <string>

#include "apps/frontend/show/page/number_map.h"

namespace dmpc::apps::html {

/// Maps of more numbers have them in 255ths of the largest.
inline constexpr std::size_t exact_numbers_max = 4096;

/// Returns JSON. Requires rows * columns numbers, at least one. Keys:
///
/// - title, row_label, column_label, value_label, rows, columns, most
/// - ticks: of the scale; column_ticks: of time, in columns, and column_ms: their length, if these are time
/// - values, or levels: base64 of a byte for each number, in 255ths of `most`, rounded up
std::string map_data(const NumberMap& map);

}  // namespace dmpc::apps::html
