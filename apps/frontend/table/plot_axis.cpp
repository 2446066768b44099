#include "apps/frontend/table/plot_axis.h"

#include <algorithm>
#include <cctype>
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

std::string gnuplot_text(const std::string& text) {
  // gnuplot takes two quotes for an empty text at the beginning, and four of them for the end.
  if (const std::size_t quote = text.starts_with('\'') ? 0 : text.find("''"); quote != std::string::npos) {
    const std::string before = text.substr(0, quote), behind = text.substr(quote + 1);
    return (before.empty() ? "" : gnuplot_text(before) + ".") + "\"'\"" + (behind.empty() ? "" : "." + gnuplot_text(behind));
  }
  std::string safe = "'";
  for (const char character : text) {
    const bool is_control = std::iscntrl(static_cast<unsigned char>(character)) != 0;
    safe += character == '\'' ? "''" : std::string(1, is_control ? ' ' : character);
  }
  return safe + "'";
}

std::string gnuplot_tic(std::string text, const std::string& position) {
  for (std::size_t at = text.find('%'); at != std::string::npos; at = text.find('%', at + 2)) {
    text.insert(at, 1, '%');
  }
  return gnuplot_text(text) + " " + position;
}

void PlotExtent::add(double value) {
  least = std::min(least, value);
  largest = std::max(largest, value);
}

std::string axis_lines(const std::string& name, const PlotAxis& axis) {
  const auto end = [](const std::optional<double>& limit) { return limit ? legend_number(*limit) : "*"; };
  const std::string base = axis.scale == PlotScale::powers_of_2 ? " 2" : " 10";
  return "set " + name + "label " + gnuplot_text(axis.label) + "\nset " + name + "range [" + end(axis.least) + ":" +
         end(axis.most) + "]\n" + (axis.scale == PlotScale::linear ? "" : "set logscale " + name + base + "\n");
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

std::string axis_lines(const std::string& name, PlotAxis axis, const PlotExtent& extent, const std::string& unit) {
  const bool has_margin = name == "y";
  const ShownAxis shown = shown_axis(axis, extent, unit, has_margin);
  if (axis.scale == PlotScale::powers_of_2 || shown.ticks.empty()) {
    return axis_lines(name, axis);
  }
  if (has_margin || axis.scale == PlotScale::powers_of_10) {
    widen(axis, {axis.least.value_or(extent.least), axis.most.value_or(extent.largest)});
  }
  std::string tics;
  for (const Tick& tick : shown.ticks) {
    tics += (tics.empty() ? "" : ", ") + gnuplot_tic(tick.text, shortest(tick.position));
  }
  return axis_lines(name, axis) + "set " + name + "tics (" + tics + ")\n";
}

}  // namespace dmpc::apps
