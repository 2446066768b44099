#include "apps/lab/bench/error/table.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "apps/edge/table/averages.h"
#include "apps/lab/bench/error/curve.h"

namespace dmpc::apps {
namespace {

constexpr double steps = 255;

std::vector<Column> error_columns() {
  return {{"scene"},
          {"knob"},
          {"setting"},
          {"samples a pixel", "", 2},
          {"rays"},
          {"rays a pixel", "", 2},
          {"seconds median", "s", 3},
          {"seconds least", "s", 3},
          {"seconds most", "s", 3},
          {"RMSE", "1/255", 3},
          {"relative MSE", "", 6},
          {"largest", "1/255", 1},
          {"99th percentile", "1/255", 2},
          {"FLIP mean", "", 4},
          {"FLIP 99th percentile", "", 3},
          {"remark"},
          {"front by rays"},
          {"front by seconds"},
          {"deterministic RMSE", "1/255", 3},
          {"deterministic relative MSE", "", 6},
          {"deterministic largest", "1/255", 1},
          {"deterministic 99th percentile", "1/255", 2},
          {"deterministic FLIP mean", "", 4},
          {"deterministic FLIP 99th percentile", "", 3}};
}

/// Nothing for what is infinite: a table has no place for it.
Cell number(double value) { return std::isfinite(value) ? Cell(value) : Cell(); }

void add_error(std::vector<Cell>& row, const PictureError& error) {
  row.insert(row.end(),
             {number(steps * error.root_mean_square), number(error.relative_mean_square), number(steps * error.largest),
              number(steps * error.percentile_99), number(error.flip_mean), number(error.flip_percentile_99)});
}

/// Which measurements are on the fronts.
struct Fronts {
  std::vector<bool> by_rays, by_seconds;
};

Fronts fronts_of(const SceneResult& result) {
  std::vector<CostPoint> rays, seconds;
  std::vector<bool> is_eligible;
  for (const Measurement& one : result.measurements) {
    const double error = one.error.root_mean_square;
    rays.push_back({static_cast<double>(one.rays), error});
    seconds.push_back({one.is_done() ? median(one.seconds) : 0, error});
    is_eligible.push_back(one.is_done() && is_claimed(result, one));
  }
  return {pareto_front(rays, is_eligible), pareto_front(seconds, is_eligible)};
}

std::vector<Cell> row_of(const SceneResult& result, const Fronts& fronts, std::size_t point) {
  const Measurement& one = result.of(point);
  const auto pixels = static_cast<double>(result.pixels());
  const auto [least, most] = std::minmax_element(one.seconds.begin(), one.seconds.end());
  std::vector<Cell> row = {result.scene,
                           std::string(name_of(result.points[point].knob)),
                           result.points[point].text,
                           static_cast<double>(one.samples) / pixels,
                           one.rays,
                           static_cast<double>(one.rays) / pixels,
                           median(one.seconds),
                           *least,
                           *most};
  add_error(row, one.error);
  const auto yes_if = [](bool is_so) { return Cell(std::string(is_so ? "yes" : "")); };
  row.insert(row.end(),
             {Cell(std::string(is_claimed(result, one) ? "" : "below the reference")),
              yes_if(fronts.by_rays[result.measurement_of[point]]), yes_if(fronts.by_seconds[result.measurement_of[point]])});
  if (const auto deterministic = deterministic_error(result, point)) {
    add_error(row, *deterministic);
  }
  row.resize(error_columns().size());
  return row;
}

void add_rows(Table& table, const SceneResult& result, bool only_claimed) {
  const Fronts fronts = fronts_of(result);
  for (std::size_t point = 0; point < result.points.size(); ++point) {
    const Measurement& one = result.of(point);
    if (one.is_done() && (!only_claimed || is_claimed(result, one))) {
      table.add_row(row_of(result, fronts, point));
    }
  }
}

/// Two knobs at once are a cloud, and so is what has one point; the others are curves.
PlotSeries series_of(Knob knob) {
  const bool is_cloud = knob >= Knob::arithmetic;
  const std::size_t color = knob == Knob::adaptive_and_depth    ? 7
                            : knob == Knob::adaptive_and_cutoff ? 5
                                                                : static_cast<std::size_t>(knob);
  return {name_of(knob), "RMSE", {{"knob", name_of(knob)}}, is_cloud ? PlotMark::points : PlotMark::line, color};
}

Plot plot_of(const SceneResult& result, const std::string& name, PlotAxis x, const std::string& column,
             const std::string& front) {
  std::vector<PlotSeries> series;
  for (const Knob knob : {Knob::samples, Knob::adaptive, Knob::cutoff, Knob::depth, Knob::tessellation, Knob::adaptive_and_cutoff,
                          Knob::adaptive_and_depth}) {
    series.push_back(series_of(knob));
  }
  series.push_back({"Pareto front", "RMSE", {{front, "yes"}}, PlotMark::line, 6});
  series.push_back({"on the front", "RMSE", {{front, "yes"}}, PlotMark::points, 6});
  x.scale = PlotScale::powers_of_10;
  return curves(name,
                result.scene + " at " + std::to_string(result.width) + "x" + std::to_string(result.height) +
                    ": error against the converged picture",
                column, std::move(x), {.label = "RMSE (1/255)", .scale = PlotScale::powers_of_10}, std::move(series));
}

}  // namespace

Table table_of(std::span<const SceneResult> results, const std::string& title) {
  Table table(title, error_columns());
  for (const SceneResult& result : results) {
    add_rows(table, result, false);
  }
  return table;
}

Table plotted_table(const SceneResult& result) {
  Table table(result.scene, error_columns());
  add_rows(table, result, true);
  return table;
}

std::vector<Plot> plots_of(const SceneResult& result, const std::string& name) {
  return {plot_of(result, name + "_seconds", {.label = "seconds to render (median)"}, "seconds median", "front by seconds"),
          plot_of(result, name + "_rays", {.label = "rays of all kinds"}, "rays", "front by rays")};
}

}  // namespace dmpc::apps
