#include "apps/lab/study/frame_rows.h"

#include <algorithm>
#include <variant>

#include "apps/frontend/line/number_text.h"
#include "dataflow/run.h"
#include "svm/packets.h"

namespace dmpc::apps {
namespace {

std::uint64_t bytes_that_travel(const svm::Report& report) {
  std::uint64_t bytes = 0;
  for (const svm::Kind kind : {svm::Kind::page_reply, svm::Kind::questions, svm::Kind::answers}) {
    bytes += report.sent()[svm::number_of(kind)].bytes;
  }
  return bytes;
}

FrameFigures own_figures_of(const svm::Report& report) {
  FrameFigures figures{.faults = report.pages().faults, .bytes = bytes_that_travel(report)};
  for (const svm::NodeReport& node : report.nodes) {
    figures.node_faults_max = std::max(figures.node_faults_max, node.program.pages.faults);
  }
  return figures;
}

FrameFigures own_figures_of(const dataflow::Report& report) { return {.bytes = dataflow::ray_traffic(report.sent()).bytes}; }

using Number = std::uint64_t FrameFigures::*;
using Frames = std::vector<FrameFigures> FrameSeries::*;

double mean_of(const FramesRow& row, Frames frames, Number number) {
  double sum = 0;
  for (std::size_t i = row.begin; i < row.end; ++i) {
    sum += static_cast<double>((row.series.*frames)[i].*number);
  }
  return sum / static_cast<double>(row.end - row.begin);
}

double warm_percent(const FramesRow& row, Number number) {
  return percent_of(mean_of(row, &FrameSeries::warm, number), mean_of(row, &FrameSeries::cold, number));
}

double worst_percent(const FramesRow& row) {
  double most = 0;
  for (std::size_t i = row.begin; i < row.end; ++i) {
    most = std::max(most, percent_of(row.series.warm[i].faults, row.series.cold[i].faults));
  }
  return most;
}

}  // namespace

FrameFigures figures_of(const Report& report) {
  return std::visit(
      [](const auto& of_strategy) {
        FrameFigures figures = own_figures_of(of_strategy);
        figures.film = of_strategy.film.hash();
        figures.messages = nodes::total(of_strategy.sent()).packets;
        figures.total_ns = of_strategy.virtual_time->total_ns;
        return figures;
      },
      report);
}

const FilledColumns<FramesRow>& frames_columns() {
  using Row = FramesRow;
  static const FilledColumns<Row> columns = [] {
    const auto of_pages = [](auto cell) { return only_if([](const Row& row) { return row.series.of.has_pages(); }, cell); };
    const auto mean = [](Frames frames, Number number) { return [=](const Row& row) { return mean_of(row, frames, number); }; };
    const auto percent = [](Number number) { return [number](const Row& row) { return warm_percent(row, number); }; };
    const auto seconds = [](Frames frames) {
      return [frames](const Row& row) { return 1e-9 * mean_of(row, frames, &FrameFigures::total_ns); };
    };
    constexpr Frames cold = &FrameSeries::cold, warm = &FrameSeries::warm;
    return FilledColumns<Row>{
        {{.name = "machine", .unit = "", .is_heading = true}, [](const Row& row) { return row.series.machine; }},
        {{"nodes"}, [](const Row& row) { return std::uint64_t{row.series.node_count}; }},
        {{"what travels"}, [](const Row& row) { return row.series.of.what; }},
        {{"frames"}, [](const Row& row) { return row.frames; }},
        {{"cache pages"}, of_pages([](const Row& row) { return std::uint64_t{row.series.of.cache_pages}; })},
        {{"share of database", "%", 1},
         of_pages([](const Row& row) { return percent_of(row.series.of.cache_pages, row.series.page_count); })},
        {{"faults cold", "", 0}, of_pages(mean(cold, &FrameFigures::faults))},
        {{"faults warm", "", 0}, of_pages(mean(warm, &FrameFigures::faults))},
        {{"warm faults", "%", 1}, of_pages(percent(&FrameFigures::faults))},
        {{"worst warm faults", "%", 1}, of_pages(worst_percent)},
        {{"messages cold", "", 0}, mean(cold, &FrameFigures::messages)},
        {{"messages warm", "", 0}, mean(warm, &FrameFigures::messages)},
        {{"traffic cold", "bytes", 0}, mean(cold, &FrameFigures::bytes)},
        {{"traffic warm", "bytes", 0}, mean(warm, &FrameFigures::bytes)},
        {{"time cold", "s", 6}, seconds(cold)},
        {{"time warm", "s", 6}, seconds(warm)},
        {{"warm time", "%", 1}, percent(&FrameFigures::total_ns)}};
  }();
  return columns;
}

}  // namespace dmpc::apps
