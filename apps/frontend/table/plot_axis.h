// The axes of a plot in gnuplot's language, and what else it takes to speak it.
#pragma once

#include <limits>
#include <string>

#include "apps/frontend/table/plot.h"

namespace dmpc::apps {

/// Without more digits than it needs.
std::string gnuplot_number(double number);
/// A text as gnuplot reads it, on one line.
std::string gnuplot_text(const std::string& text);
/// A tic's text at a position along its axis. gnuplot puts the position where such a text has a format, so '%' is said twice.
std::string gnuplot_tic(std::string text, const std::string& position);

/// The least and the largest of what is drawn.
struct PlotExtent {
  double least = std::numeric_limits<double>::infinity();
  double largest = -std::numeric_limits<double>::infinity();

  void add(double value);
};

/// Label, limits and scale of the axis "x" or "y".
std::string axis_lines(const std::string& name, const PlotAxis& axis);
/// Lines for an axis with round ticks as people read them, for numbers counted in `unit`; those of powers of two are gnuplot's
/// own.
std::string axis_lines(const std::string& name, PlotAxis axis, const PlotExtent& extent, const std::string& unit);

}  // namespace dmpc::apps
