#include "apps/frontend/table/plot_axis.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "apps/frontend/line/number_text.h"

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

std::vector<Tick> ticks_at_powers_of_2(const PlotExtent& shown) {
  std::vector<Tick> ticks;
  for (double power = std::exp2(std::ceil(std::log2(shown.least))); power <= shown.largest; power *= 2) {
    ticks.push_back({power, legend_number(power)});
  }
  return ticks;
}

}  // namespace

void PlotExtent::add(double value) {
  least = std::min(least, value);
  largest = std::max(largest, value);
}

ShownAxis shown_axis(PlotAxis axis, const PlotExtent& extent, const std::string& unit, bool has_margin) {
  const bool is_logarithmic = axis.scale == PlotScale::powers_of_10;
  PlotExtent shown{axis.least.value_or(extent.least), axis.most.value_or(extent.largest)};
  if (!(shown.largest > shown.least) || (axis.scale != PlotScale::linear && shown.least <= 0)) {
    return {shown.least, shown.least + 1, {}};
  }
  if (has_margin || is_logarithmic) {
    widen(axis, shown);
    shown = {axis.least.value_or(shown.least), axis.most.value_or(shown.largest)};
  }
  return {shown.least, shown.largest,
          axis.scale == PlotScale::powers_of_2 ? ticks_at_powers_of_2(shown)
                                               : amount_ticks(shown.least, shown.largest, is_logarithmic, unit)};
}

}  // namespace dmpc::apps
