// Numbers in rows and columns as squares of colour, with named axes, round ticks and a scale of colours: SVG.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/picture/image_file.h"

namespace dmpc::apps::html {

/// What is shown. Rows are counted from 0, at the top.
struct NumberMap {
  std::string title;
  std::string row_label, column_label;  ///< of the axes
  std::string value_label;              ///< of the scale, with its unit where `unit` is none that amounts know
  std::string unit;                     ///< as amount_ticks() takes it
  std::size_t rows = 0, columns = 0;
  std::vector<double> values;         ///< row by row, not negative
  std::optional<double> column_ns{};  ///< columns are steps of time from 0 on, so long each; nothing: they are counted
  std::optional<double> most{};       ///< of the scale; nothing: the largest number
};

/// Requires rows * columns numbers. Few and large squares have their numbers written in them.
std::string svg_of(const NumberMap& map);

/// A pixel for each number, row by row, from dark (0) to light (`most`).
Image number_picture(std::span<const double> values, std::size_t rows, std::size_t columns, double most);

}  // namespace dmpc::apps::html
