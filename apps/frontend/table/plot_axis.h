// The axes of a plot in gnuplot's language, and helpers for writing it.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "apps/frontend/line/amount.h"
#include "apps/frontend/table/plot.h"

namespace dmpc::apps {

/// Quotes a text for gnuplot, on one line.
std::string gnuplot_text(const std::string& text);
/// Returns a tic's text at a position along its axis. gnuplot takes such a text as a format for the position, so '%' is doubled.
std::string gnuplot_tic(std::string text, const std::string& position);

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

/// Returns label, limits and scale of the axis "x" or "y".
std::string axis_lines(const std::string& name, const PlotAxis& axis);
/// Returns lines for an axis with round ticks for numbers counted in `unit`; gnuplot itself places ticks at powers of two.
std::string axis_lines(const std::string& name, PlotAxis axis, const PlotExtent& extent, const std::string& unit);

}  // namespace dmpc::apps
