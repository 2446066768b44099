// The part of its table that a plot draws.
#pragma once

#include <string>
#include <vector>

#include "apps/frontend/table/plot.h"
#include "apps/frontend/table/plot_axis.h"

namespace dmpc::apps {

/// Series that have a row, places of bars, and extents. Plot and table outlive this.
class DrawnPlot {
 public:
  /// Requires columns that the table has, and names of one line for places.
  DrawnPlot(const Plot& plot, const Table& table);

  bool is_bars() const { return is_bars_; }
  /// Whether bars stand at named positions.
  bool has_places() const { return is_bars_ && !plot_.bar_width; }
  const std::vector<const PlotSeries*>& series() const { return drawn_; }
  const std::vector<std::string>& places() const { return places_; }

  bool is_meant(const PlotSeries& series, const std::vector<Cell>& row) const;
  /// The number along x, or the number of the place, from 0 on.
  double x_of(const std::vector<Cell>& row) const;
  double number_in(const std::vector<Cell>& row, const std::string& column) const;
  PlotExtent span_of_x() const;
  PlotExtent span_of_y() const;

 private:
  bool is_any_meant(const std::vector<Cell>& row) const;
  std::string place_in(const std::vector<Cell>& row) const;

  const Plot& plot_;
  const Table& table_;
  bool is_bars_ = false;
  std::vector<const PlotSeries*> drawn_;  ///< series that have a row
  std::vector<std::string> places_;       ///< names of bars
};

}  // namespace dmpc::apps
