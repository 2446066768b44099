#include "apps/lab/bench/speed/table.h"

#include <algorithm>
#include <utility>

#include "apps/edge/table/averages.h"

namespace dmpc::apps {
namespace {

std::vector<Column> columns() {
  return {{"part"},
          {"scene"},
          {"what"},
          {"detail"},
          {"threads or nodes"},
          {"subject"},
          {"rival"},
          {"unit"},
          {"subject's figure", "", 4},
          {"rival's figure", "", 4},
          {"ratio", "", 3},
          {"least ratio", "", 3},
          {"largest ratio", "", 3},
          {"rounds"}};
}

double median_of(const std::vector<double>& figures, std::size_t rounds) {
  return median({figures.begin(), figures.begin() + static_cast<std::ptrdiff_t>(rounds)});
}

std::vector<Cell> row_of(const Comparison& comparison) {
  const std::size_t rounds = comparison.rounds();
  const RatioSpread ratio = ratio_of(comparison);
  return {std::string(name_of(comparison.part)),
          comparison.scene,
          comparison.what,
          comparison.detail,
          comparison.threads == 0 ? Cell() : Cell(std::uint64_t{comparison.threads}),
          comparison.subject,
          comparison.rival,
          comparison.unit,
          median_of(comparison.subject_figures, rounds),
          median_of(comparison.rival_figures, rounds),
          ratio.median,
          ratio.least,
          ratio.most,
          std::uint64_t{rounds}};
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
  Table table(title, columns());
  for (const Comparison* const comparison : measured(comparisons, [](const Comparison&) { return true; })) {
    table.add_row(row_of(*comparison));
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
