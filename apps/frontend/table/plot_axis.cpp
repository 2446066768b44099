#include "apps/frontend/table/plot_axis.h"

#include <algorithm>
#include <optional>

namespace dmpc::apps {

namespace {

/// Space above the highest value, as a share of it.
constexpr double headroom = 0.04;
/// Space above and below on a logarithmic axis.
constexpr double margin_factor = 1.25;

/// Adds space around the values if no limits are given.
void widen(PlotAxis& axis, const PlotExtent& extent) {
  const bool is_logarithmic = axis.scale == PlotScale::powers_of_10;
  if (!axis.most) {
    axis.most = is_logarithmic ? extent.largest * margin_factor : extent.largest + headroom * (extent.largest - extent.least);
  }
  if (!axis.least && is_logarithmic) {
    axis.least = extent.least / margin_factor;
  }
}

}  // namespace

void PlotExtent::add(double value) {
  least = std::min(least, value);
  largest = std::max(largest, value);
}

ShownAxis shown_axis(PlotAxis axis, const PlotExtent& extent, const std::string& unit, bool has_margin) {
  const bool is_logarithmic = axis.scale == PlotScale::powers_of_10;
  PlotExtent shown{axis.least.value_or(extent.least), axis.most.value_or(extent.largest)};
  if (!(shown.largest > shown.least) || (is_logarithmic && shown.least <= 0)) {
    return {shown.least, shown.least + 1, {}};
  }
  if (has_margin || is_logarithmic) {
    widen(axis, shown);
    shown = {axis.least.value_or(shown.least), axis.most.value_or(shown.largest)};
  }
  return {shown.least, shown.largest, amount_ticks(shown.least, shown.largest, is_logarithmic, unit)};
}

}  // namespace dmpc::apps
