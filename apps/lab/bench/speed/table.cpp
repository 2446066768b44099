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

/// One bar, and what its height is the mean of.
struct Bar {
  std::string scene, what, pair;
  std::vector<double> ratios;
};

std::string pair_named_in(const Comparison& comparison) {
  const bool is_threaded = comparison.part == SpeedPart::kernel || comparison.part == SpeedPart::build;
  const std::string threads = is_threaded ? " x" + std::to_string(comparison.threads) : "";
  return comparison.subject + " / " + comparison.rival + threads;
}

std::vector<Bar> bars_of(SpeedPart part, std::span<const Comparison> comparisons) {
  std::vector<Bar> bars;
  for (const Comparison& comparison : comparisons) {
    const bool is_timed = comparison.part == SpeedPart::picture || comparison.part == SpeedPart::emulation;
    if (comparison.part != part || comparison.rounds() == 0 || (is_timed && !comparison.is_by_wall_clock())) {
      continue;
    }
    const std::string pair = pair_named_in(comparison);
    const auto is_same = [&](const Bar& bar) {
      return bar.scene == comparison.scene && bar.what == comparison.what && bar.pair == pair;
    };
    auto found = std::find_if(bars.begin(), bars.end(), is_same);
    found = found == bars.end() ? bars.insert(found, {comparison.scene, comparison.what, pair, {}}) : found;
    found->ratios.push_back(ratio_of(comparison).median);
  }
  return bars;
}

}  // namespace

Table table_of(std::span<const Comparison> comparisons, const std::string& title) {
  Table table(title, columns());
  for (const Comparison& comparison : comparisons) {
    if (comparison.rounds() > 0) {
      table.add_row(row_of(comparison));
    }
  }
  return table;
}

Table plotted_table(SpeedPart part, std::span<const Comparison> comparisons) {
  Table table(name_of(part), {{"scene"}, {"what"}, {"pair"}, {"ratio"}});
  for (const Bar& bar : bars_of(part, comparisons)) {
    table.add_row({bar.scene, bar.what, bar.pair, *geometric_mean(bar.ratios)});
  }
  return table;
}

Plot plot_of(SpeedPart part, const Table& plotted, const std::string& name) {
  Plot plot{.name = name,
            .title = std::string("Speed: ") + name_of(part),
            .places = {"scene", "what"},
            .x = {},
            .y = {.label = part == SpeedPart::kernel ? "ratio (more is better)" : "ratio (less is better)", .least = 0},
            .series = {}};
  for (const auto& row : plotted.rows()) {
    const auto& pair = std::get<std::string>(row[2]);
    const auto is_same = [&](const PlotSeries& series) { return series.title == pair; };
    if (std::none_of(plot.series.begin(), plot.series.end(), is_same)) {
      plot.series.push_back({pair, "ratio", {{"pair", pair}}, PlotMark::bars, plot.series.size() % 8});
    }
  }
  return plot;
}

}  // namespace dmpc::apps
