#include "apps/frontend/table/drawn_plot.h"

#include <algorithm>
#include <cstdint>
#include <optional>

#include "core/base/expect.h"

namespace dmpc::apps {

namespace {

/// Returns a name of a position as in the CSV file: a text or a whole number.
std::string text_of_cell(const Cell& cell) {
  const std::string* const text = std::get_if<std::string>(&cell);
  const std::uint64_t* const number = std::get_if<std::uint64_t>(&cell);
  core::expect(text != nullptr || number != nullptr, "a place in a plot has a name or a whole number");
  const std::string name = text != nullptr ? *text : std::to_string(*number);
  core::expect(name.find_first_of("\r\n") == std::string::npos, "a place in a plot has a name of one line");
  return name;
}

bool stands_at_place(const PlotSeries& series) { return series.mark == PlotMark::bars || series.mark == PlotMark::bands; }

}  // namespace

DrawnPlot::DrawnPlot(const Plot& plot, const Table& table) : plot_(plot), table_(table) {
  is_bars_ = std::any_of(plot.series.begin(), plot.series.end(), stands_at_place);
  for (const PlotSeries& series : plot.series) {
    core::expect(stands_at_place(series) == is_bars_, "the series of a plot are all bars or bands, or none is");
    core::expect(series.color < plot_color_count, "a plot has so many colours");
    if (std::any_of(table.rows().begin(), table.rows().end(), [&](const auto& row) { return is_meant(series, row); })) {
      drawn_.push_back(&series);
    }
  }
  for (const std::vector<Cell>& row : table.rows()) {
    if (has_places() && is_any_meant(row)) {
      if (const std::string name = place_in(row); std::find(places_.begin(), places_.end(), name) == places_.end()) {
        places_.push_back(name);
      }
    }
  }
}

/// The axis can show the row's number.
bool DrawnPlot::is_meant(const PlotSeries& series, const std::vector<Cell>& row) const {
  const std::optional<double> number = number_of(row[number_of_column(table_, series.column)]);
  return number && (plot_.y.scale == PlotScale::linear || *number > 0);
}

bool DrawnPlot::is_any_meant(const std::vector<Cell>& row) const {
  return std::any_of(drawn_.begin(), drawn_.end(), [&](const auto* series) { return is_meant(*series, row); });
}

std::string DrawnPlot::place_in(const std::vector<Cell>& row) const {
  return text_of_cell(row[number_of_column(table_, plot_.place)]);
}

double DrawnPlot::x_of(const std::vector<Cell>& row) const {
  return has_places() ? static_cast<double>(std::find(places_.begin(), places_.end(), place_in(row)) - places_.begin())
                      : number_in(row, plot_.place);
}

double DrawnPlot::number_in(const std::vector<Cell>& row, const std::string& column) const {
  return number_of(row[number_of_column(table_, column)]).value_or(0);
}

PlotExtent DrawnPlot::span_of_x() const {
  PlotExtent extent;
  for (const std::vector<Cell>& row : table_.rows()) {
    if (is_any_meant(row)) {
      const double x = number_in(row, plot_.place);
      extent.add(x);
      extent.add(x + plot_.bar_width.value_or(0));
    }
  }
  return extent;
}

PlotExtent DrawnPlot::span_of_y() const {
  PlotExtent extent;
  for (const std::vector<Cell>& row : table_.rows()) {
    double sum = 0;
    for (const PlotSeries* series : drawn_) {
      if (is_meant(*series, row)) {
        const double value = number_in(row, series->column);
        sum = plot_.is_stacked ? sum + value : value;
        extent.add(sum);
        if (series->mark == PlotMark::bands) {
          extent.add(number_in(row, series->low));
          extent.add(number_in(row, series->high));
        }
      }
    }
  }
  return extent;
}

}  // namespace dmpc::apps
