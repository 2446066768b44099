#include "apps/lab/bench/speed/table.h"

#include <algorithm>
#include <utility>

#include "apps/edge/table/averages.h"
#include "apps/edge/table/filled_columns.h"

namespace dmpc::apps {
namespace {

/// The middle one of the rounds that both have ended.
double median_of(const Comparison& comparison, const std::vector<double>& figures) {
  return median({figures.begin(), figures.begin() + static_cast<std::ptrdiff_t>(comparison.rounds())});
}

const FilledColumns<Comparison>& comparison_columns() {
  using C = Comparison;
  static const FilledColumns<C> columns = {
      {{"part"}, [](const C& c) { return name_of(c.part); }},
      {{"scene"}, &C::scene},
      {{"what"}, &C::what},
      {{"detail"}, &C::detail},
      {{"threads or nodes"}, [](const C& c) { return c.threads == 0 ? Cell() : Cell(std::uint64_t{c.threads}); }},
      {{"subject"}, &C::subject},
      {{"rival"}, &C::rival},
      {{"unit"}, &C::unit},
      {{"subject's figure", "", 4}, [](const C& c) { return median_of(c, c.subject_figures); }},
      {{"rival's figure", "", 4}, [](const C& c) { return median_of(c, c.rival_figures); }},
      {{"ratio", "", 3}, [](const C& c) { return ratio_of(c).median; }},
      {{"least ratio", "", 3}, [](const C& c) { return ratio_of(c).least; }},
      {{"largest ratio", "", 3}, [](const C& c) { return ratio_of(c).most; }},
      {{"rounds"}, &C::rounds}};
  return columns;
}

std::string pair_named_in(const Comparison& comparison) {
  const bool is_threaded = comparison.part == SpeedPart::kernel || comparison.part == SpeedPart::build;
  const std::string threads = is_threaded ? " x" + std::to_string(comparison.threads) : "";
  return comparison.subject + " / " + comparison.rival + threads;
}

/// What a bar's height is the mean of.
bool are_of_one_bar(const Comparison& a, const Comparison& b) {
  return a.scene == b.scene && a.what == b.what && pair_named_in(a) == pair_named_in(b);
}

}  // namespace

Table table_of(std::span<const Comparison> comparisons, const std::string& title) {
  Table table(title, heads_of(comparison_columns()));
  for (const Comparison* const comparison : measured(comparisons, [](const Comparison&) { return true; })) {
    table.add_row(row_of(comparison_columns(), *comparison));
  }
  return table;
}

Table plotted_table(SpeedPart part, std::span<const Comparison> comparisons) {
  const bool is_timed = part == SpeedPart::picture || part == SpeedPart::emulation;
  const auto is_meant = [&](const Comparison& one) { return one.part == part && (!is_timed || one.is_by_wall_clock()); };
  Table table(name_of(part), {{"scene"}, {"what"}, {"pair"}, {"ratio"}});
  for (const Comparisons& bar : grouped(measured(comparisons, is_meant), are_of_one_bar)) {
    const Comparison& one = *bar.front();
    table.add_row({one.scene, one.what, pair_named_in(one), *geometric_mean(ratios_of(bar))});
  }
  return table;
}

Plot plot_of(SpeedPart part, const Table& plotted, const std::string& name) {
  return with_bars("ratio", 2, plotted,
                   {.name = name,
                    .title = std::string("Speed: ") + name_of(part),
                    .places = {"scene", "what"},
                    .x = {},
                    .y = {.label = part == SpeedPart::kernel ? "ratio (more is better)" : "ratio (less is better)", .least = 0},
                    .series = {}});
}

Plot with_bars(const std::string& height, std::size_t kind, const Table& table, Plot plot) {
  for (const auto& row : table.rows()) {
    const auto& text = std::get<std::string>(row[kind]);
    const auto is_same = [&](const PlotSeries& series) { return series.title == text; };
    if (std::none_of(plot.series.begin(), plot.series.end(), is_same)) {
      plot.series.push_back({text, height, {{table.columns()[kind].name, text}}, PlotMark::bars, plot.series.size() % 8});
    }
  }
  return plot;
}

}  // namespace dmpc::apps
