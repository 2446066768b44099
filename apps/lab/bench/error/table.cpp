#include "apps/lab/bench/error/table.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "apps/frontend/table/filled_columns.h"
#include "apps/lab/bench/error/findings.h"

namespace dmpc::apps {
namespace {

constexpr double steps = 255;
constexpr const char* front_of_samples = "front of uniform and adaptive";

struct Fronts {
  std::vector<bool> of_all, of_samples;  ///< by measurement: among all points, and those of uniform and adaptive sampling
};

bool is_of_samples(Knob knob) { return knob == Knob::samples || knob == Knob::adaptive; }

Fronts fronts_of(const SceneResult& result) {
  std::vector<CostPoint> points;
  std::vector<bool> is_drawn, is_sampling(result.measurements.size());
  for (const Measurement& one : result.measurements) {
    points.push_back({one.is_done() ? one.least_seconds() : 0, error_of(one)});
    is_drawn.push_back(is_told(result, one));
  }
  for (std::size_t point = 0; point < result.points.size(); ++point) {
    const std::size_t one = result.measurement_of[point];
    is_sampling[one] = is_sampling[one] || (is_of_samples(result.points[point].knob) && is_drawn[one]);
  }
  return {pareto_front(points, is_drawn), pareto_front(points, is_sampling)};
}

struct ErrorRow {
  const SceneResult& result;
  const Fronts& fronts;
  std::size_t point;

  const Point& place() const { return result.points[point]; }
  std::size_t index() const { return result.measurement_of[point]; }
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
      {{"seconds least", "s", 3}, [](const Row& row) { return row.measured().least_seconds(); }},
      {{"seconds most", "s", 3}, [](const Row& row) { return std::ranges::max(row.measured().seconds); }}};
  const auto add = [&](const char* name, double Estimate::*part) {
    columns.push_back({{name, "1/255", 3}, [part](const Row& row) {
                         const bool told = is_told(row.result, row.measured());
                         return told ? Cell(steps * error_interval(row.measured()).*part) : Cell();
                       }});
  };
  add("error", &Estimate::middle);
  add("error low", &Estimate::low);
  add("error high", &Estimate::high);
  columns.push_back({{"remark"}, [](const Row& row) {
                       return std::string(is_told(row.result, row.measured()) ? "" : "less than the reference's own error");
                     }});
  columns.push_back({{"front"}, [](const Row& row) { return yes_if(row.fronts.of_all[row.index()]); }});
  columns.push_back({{front_of_samples}, [](const Row& row) { return yes_if(row.fronts.of_samples[row.index()]); }});
  add_errors(
      "", [](const Row& row) { return std::optional(row.measured().error); }, columns);
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

void add_rows(Table& table, const SceneResult& result, const FilledColumns<ErrorRow>& columns) {
  const Fronts fronts = fronts_of(result);
  for (std::size_t point = 0; point < result.points.size(); ++point) {
    if (result.of(point).is_done()) {
      table.add_row(row_of(columns, ErrorRow{result, fronts, point}));
    }
  }
}

/// Knobs that only paths have take the colours of those that paths do not have; black is the front's.
std::size_t color_of(Knob knob) {
  const auto number = static_cast<std::size_t>(knob);
  return knob >= Knob::bounces ? number - 5 : knob == Knob::quality ? number - 1 : number;
}

PlotSeries series_of(Knob knob, PlotMark mark) {
  const std::string name = name_of(knob);
  return {.title = knob == Knob::samples    ? "uniform sampling"
                   : knob == Knob::adaptive ? "adaptive sampling"
                                            : name,
          .column = "error",
          .where = {{"knob", name}},
          .mark = mark,
          .color = color_of(knob),
          .low = "error low",
          .high = "error high"};
}

PlotSeries front_series(const char* column) {
  return {.title = "on the front", .column = "error", .where = {{column, "yes"}}, .mark = PlotMark::points, .color = 6};
}

Plot plot_of(const SceneResult& result, const std::string& name, const std::string& title, std::vector<PlotSeries> series) {
  const std::string size = std::to_string(result.width) + "x" + std::to_string(result.height);
  return curves(name, result.scene + ": " + title, "seconds least",
                {.label = "processor time of " + size + " pixels (least of the rounds)", .scale = PlotScale::powers_of_10},
                {.label = "error without the reference's own (RMSE, 1/255)", .scale = PlotScale::powers_of_10},
                std::move(series));
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

std::vector<Plot> plots_of(const SceneResult& result, const std::string& name) {
  const std::vector<AdaptiveShare> shares = adaptive_shares(result);
  std::vector<PlotSeries> sampling, knobs;
  for (const Knob knob : {Knob::samples, Knob::adaptive, Knob::cutoff, Knob::depth, Knob::tessellation, Knob::quality,
                          Knob::bounces, Knob::roulette, Knob::emitters}) {
    knobs.push_back(series_of(knob, knob == Knob::quality ? PlotMark::points : PlotMark::line));
    if (is_of_samples(knob)) {
      sampling.push_back(series_of(knob, PlotMark::intervals));
    }
  }
  sampling.push_back(front_series(front_of_samples));
  knobs.push_back(front_series("front"));
  std::vector<Plot> plots = {
      plot_of(result, name, shares.empty() ? "error against time" : text_of(std::span(shares).last(1)), std::move(sampling))};
  const auto is_other = [](const Point& point) { return !is_of_samples(point.knob) && point.knob != Knob::arithmetic; };
  if (std::ranges::any_of(result.points, is_other)) {
    plots.push_back(plot_of(result, knobs_plot_of(name), "the other knobs", std::move(knobs)));
  }
  return plots;
}

std::string knobs_plot_of(const std::string& name) { return name + "_knobs"; }

}  // namespace dmpc::apps
