// A matrix of numbers, which a page's script shows as coloured squares with named axes and a scale.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace dmpc::apps::html {

/// Rows are counted from 0, at the top.
struct NumberMap {
  std::string title;
  std::string row_label, column_label;  ///< axis labels
  std::string value_label;              ///< label of the scale, with its unit where `unit` is not one that amounts know
  std::string unit;                     ///< as amount_ticks() takes it
  std::size_t rows = 0, columns = 0;
  std::vector<double> values;         ///< row by row, not negative
  std::optional<double> column_ns{};  ///< duration of a column, if columns are steps of time from 0 on; nothing: counted
  std::optional<double> most{};       ///< upper end of the scale; nothing: the largest number
};

}  // namespace dmpc::apps::html
