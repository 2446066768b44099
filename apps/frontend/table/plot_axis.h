// Limits and ticks of the axes of a plot.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "apps/frontend/line/amount.h"
#include "apps/frontend/table/plot.h"

namespace dmpc::apps {

/// The least and the largest value drawn.
struct PlotExtent {
  double least = std::numeric_limits<double>::infinity();
  double largest = -std::numeric_limits<double>::infinity();

  void add(double value);
};

/// Limits and ticks of an axis; no ticks where all values are the same.
struct ShownAxis {
  double least = 0, most = 1;
  std::vector<Tick> ticks = {};
};
/// Returns round ticks for numbers counted in `unit`. `has_margin`: with some space around the values if no limits are given, as
/// logarithmic axes always have.
ShownAxis shown_axis(PlotAxis axis, const PlotExtent& extent, const std::string& unit, bool has_margin);

}  // namespace dmpc::apps
