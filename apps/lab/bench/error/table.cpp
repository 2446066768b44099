#include "apps/lab/bench/error/table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "apps/frontend/table/averages.h"
#include "apps/frontend/table/filled_columns.h"
#include "apps/lab/bench/error/result.h"

namespace dmpc::apps {
namespace {

constexpr double steps = 255;

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

struct ErrorRow {
  const SceneResult& result;
  const Fronts& fronts;
  std::size_t point;

  const Point& place() const { return result.points[point]; }
  const Measurement& measured() const { return result.of(point); }
  double a_pixel(std::uint64_t count) const { return static_cast<double>(count) / static_cast<double>(result.pixels()); }
};

/// Returns an empty cell for infinity, which a table cannot hold.
Cell number(double value) { return std::isfinite(value) ? Cell(value) : Cell(); }

Cell yes_if(bool is_so) { return std::string(is_so ? "yes" : ""); }

/// Adds a column for each measure of a row's `error`, if the row has one.
template <class Error>
void add_errors(const std::string& kind, const Error& error, FilledColumns<ErrorRow>& columns) {
  const auto add = [&](Column column, double PictureError::*measure, double scale) {
    column.name = kind + column.name;
    columns.push_back({std::move(column), [error, measure, scale](const ErrorRow& row) {
                         const std::optional<PictureError> found = error(row);
                         return found ? number(scale * (*found).*measure) : Cell();
                       }});
  };
  add({"RMSE", "1/255", 3}, &PictureError::root_mean_square, steps);
  add({"relative MSE", "", 6}, &PictureError::relative_mean_square, 1);
  add({"largest", "1/255", 1}, &PictureError::largest, steps);
  add({"99th percentile", "1/255", 2}, &PictureError::percentile_99, steps);
  add({"FLIP mean", "", 4}, &PictureError::flip_mean, 1);
  add({"FLIP 99th percentile", "", 3}, &PictureError::flip_percentile_99, 1);
}

FilledColumns<ErrorRow> make_error_columns() {
  using Row = ErrorRow;
  FilledColumns<Row> columns = {
      {{"scene"}, [](const Row& row) { return row.result.scene; }},
      {{"knob"}, [](const Row& row) { return name_of(row.place().knob); }},
      {{"setting"}, [](const Row& row) { return row.place().text; }},
      {{"samples a pixel", "", 2}, [](const Row& row) { return row.a_pixel(row.measured().samples); }},
      {{"rays"}, [](const Row& row) { return row.measured().rays; }},
      {{"rays a pixel", "", 2}, [](const Row& row) { return row.a_pixel(row.measured().rays); }},
      {{"seconds median", "s", 3}, [](const Row& row) { return median(row.measured().seconds); }},
      {{"seconds least", "s", 3}, [](const Row& row) { return std::ranges::min(row.measured().seconds); }},
      {{"seconds most", "s", 3}, [](const Row& row) { return std::ranges::max(row.measured().seconds); }}};
  add_errors(
      "", [](const Row& row) { return std::optional(row.measured().error); }, columns);
  columns.push_back({{"remark"}, [](const Row& row) {
                       return std::string(is_claimed(row.result, row.measured()) ? "" : "less than 10 times the reference's own");
                     }});
  const auto is_on = [](const std::vector<bool>& front, const Row& row) {
    return yes_if(front[row.result.measurement_of[row.point]]);
  };
  columns.push_back({{"front by rays"}, [is_on](const Row& row) { return is_on(row.fronts.by_rays, row); }});
  columns.push_back({{"front by seconds"}, [is_on](const Row& row) { return is_on(row.fronts.by_seconds, row); }});
  add_errors(
      "deterministic ", [](const Row& row) { return deterministic_error(row.result, row.point); }, columns);
  return columns;
}

const FilledColumns<ErrorRow>& error_columns() {
  static const FilledColumns<ErrorRow> columns = make_error_columns();
  return columns;
}

/// No error of a picture by paths is due to one knob alone.
FilledColumns<ErrorRow> columns_of(bool are_by_paths) {
  FilledColumns<ErrorRow> columns = error_columns();
  std::erase_if(columns, [&](const auto& one) { return are_by_paths && one.column.name.starts_with("deterministic"); });
  return columns;
}

/// Additional columns for plots: the error of claimed rows as it is, and for others the remaining error with its interval.
FilledColumns<ErrorRow> make_drawn_columns() {
  using Row = ErrorRow;
  FilledColumns<Row> columns = error_columns();
  columns.push_back({{"drawn RMSE", "1/255", 3}, [](const Row& row) {
                       return is_claimed(row.result, row.measured()) ? Cell(steps * row.measured().error.root_mean_square)
                                                                     : Cell();
                     }});
  const auto add = [&](const char* name, double ErrorInterval::*end) {
    columns.push_back({{name, "1/255", 3}, [end](const Row& row) {
                         return is_claimed(row.result, row.measured())
                                    ? Cell()
                                    : Cell(steps * error_interval(row.result, row.measured()).*end);
                       }});
  };
  add("RMSE without the reference's", &ErrorInterval::middle);
  add("least without", &ErrorInterval::low);
  add("most without", &ErrorInterval::high);
  return columns;
}

const FilledColumns<ErrorRow>& drawn_columns() {
  static const FilledColumns<ErrorRow> columns = make_drawn_columns();
  return columns;
}

void add_rows(Table& table, const SceneResult& result, const FilledColumns<ErrorRow>& columns) {
  const Fronts fronts = fronts_of(result);
  for (std::size_t point = 0; point < result.points.size(); ++point) {
    if (result.of(point).is_done()) {
      table.add_row(row_of(columns, ErrorRow{result, fronts, point}));
    }
  }
}

std::size_t color_of(Knob knob) {
  return knob == Knob::adaptive_and_depth    ? 7
         : knob == Knob::adaptive_and_cutoff ? 5
         : knob == Knob::bounces             ? color_of(Knob::depth)
         : knob == Knob::roulette            ? color_of(Knob::cutoff)
         : knob == Knob::emitters            ? color_of(Knob::tessellation)
                                             : static_cast<std::size_t>(knob);
}

/// Two knobs at once form a cloud, as does a single point; the others form curves.
PlotSeries series_of(Knob knob) {
  const bool is_of_paths = knob == Knob::bounces || knob == Knob::roulette || knob == Knob::emitters;
  const bool is_cloud = knob >= Knob::arithmetic && !is_of_paths;
  return {name_of(knob), "drawn RMSE", {{"knob", name_of(knob)}}, is_cloud ? PlotMark::points : PlotMark::line, color_of(knob)};
}

/// A knob's points whose error is too near to the reference's own.
PlotSeries uncertain_series_of(Knob knob) {
  return {.title = std::string(name_of(knob)) + ", uncertain",
          .column = "RMSE without the reference's",
          .where = {{"knob", name_of(knob)}},
          .mark = PlotMark::intervals,
          .color = color_of(knob),
          .low = "least without",
          .high = "most without"};
}

Plot plot_of(const SceneResult& result, const std::string& name, PlotAxis x, const std::string& column,
             const std::string& front) {
  std::vector<PlotSeries> series;
  constexpr std::array whitted{
      Knob::samples,           Knob::adaptive, Knob::cutoff, Knob::depth, Knob::tessellation, Knob::adaptive_and_cutoff,
      Knob::adaptive_and_depth};
  constexpr std::array paths{Knob::samples, Knob::adaptive, Knob::bounces, Knob::roulette, Knob::emitters};
  for (const Knob knob : result.base.is_by_paths() ? std::span<const Knob>(paths) : std::span<const Knob>(whitted)) {
    series.push_back(series_of(knob));
    series.push_back(uncertain_series_of(knob));
  }
  series.push_back({"Pareto front", "drawn RMSE", {{front, "yes"}}, PlotMark::line, 6});
  series.push_back({"on the front", "drawn RMSE", {{front, "yes"}}, PlotMark::points, 6});
  x.scale = PlotScale::powers_of_10;
  return curves(name,
                result.scene + " at " + std::to_string(result.width) + "x" + std::to_string(result.height) +
                    ": error against the converged picture",
                column, std::move(x), {.label = "RMSE (1/255)", .scale = PlotScale::powers_of_10}, std::move(series));
}

}  // namespace

Table table_of(std::span<const SceneResult> results, const std::string& title) {
  const FilledColumns<ErrorRow> columns = columns_of(!results.empty() && results.front().base.is_by_paths());
  Table table(title, heads_of(columns));
  for (const SceneResult& result : results) {
    add_rows(table, result, columns);
  }
  return table;
}

Table plotted_table(const SceneResult& result) {
  Table table(result.scene, heads_of(drawn_columns()));
  add_rows(table, result, drawn_columns());
  return table;
}

std::vector<Plot> plots_of(const SceneResult& result, const std::string& name) {
  const bool is_by_paths = result.base.is_by_paths();
  return {plot_of(result, name + "_seconds",
                  {.label = is_by_paths ? "processor seconds to render (median)" : "seconds to render (median)"},
                  "seconds median", "front by seconds"),
          plot_of(result, name + "_rays", {.label = "rays of all kinds"}, "rays", "front by rays")};
}

}  // namespace dmpc::apps
