#include "apps/lab/bench/speed/ablation_table.h"

#include <algorithm>
#include <utility>

#include "apps/edge/table/averages.h"
#include "apps/lab/bench/speed/table.h"
#include "apps/lab/bench/speed/verdict.h"

namespace dmpc::apps {
namespace {

std::vector<Column> ablation_columns() {
  return {{"scene"},
          {"skip"},
          {"kind"},
          {"strategy"},
          {"nodes"},
          {"processor time with it", "s", 3},
          {"without over with", "", 3},
          {"least", "", 3},
          {"largest", "", 3},
          {"counted work", "", 3},
          {"avoided"},
          {"avoided what"},
          {"root mean square error", "1/255", 4},
          {"here"}};
}

std::string kind_of(const Ablation& ablation) {
  return ablation.is_control() ? "noise" : ablation.is_exact() ? "exact" : "bounded";
}

std::vector<Cell> row_of(const Ablation& ablation) {
  const Comparison& seconds = ablation.seconds;
  const RatioSpread ratio = ratio_of(seconds);
  return {seconds.scene,
          seconds.what,
          kind_of(ablation),
          seconds.detail,
          std::uint64_t{seconds.threads},
          median(seconds.rival_figures),
          ratio.median,
          ratio.least,
          ratio.most,
          ablation.work_ratio,
          ablation.avoided ? Cell(*ablation.avoided) : Cell(),
          ablation.unit,
          ablation.error ? Cell(255 * *ablation.error) : Cell(),
          ablation.is_control() ? Cell() : Cell(text_of(verdict_on(ablation)))};
}

}  // namespace

Table table_of(std::span<const Ablation> ablations, const std::string& title) {
  Table table(title, ablation_columns());
  for (const Ablation& ablation : ablations) {
    table.add_row(row_of(ablation));
  }
  for (std::string& sentence : verdicts_on(ablations)) {
    table.add_note(std::move(sentence));
  }
  return table;
}

Table plotted_table(std::span<const Ablation> ablations) {
  Table table("ablation", {{"scene"}, {"skip"}, {"time"}, {"work"}});
  for (const Ablation& ablation : ablations) {
    if (!ablation.is_control()) {
      table.add_row({ablation.seconds.scene, ablation.seconds.what, ratio_of(ablation.seconds).median, ablation.work_ratio});
    }
  }
  return table;
}

Plot plot_of_ablation(const Table& plotted, const std::string& name) {
  return with_bars("work", 1, plotted,
                   {.name = name,
                    .title = "Counted work without a skip, over that with it",
                    .places = {"scene"},
                    .x = {},
                    .y = {.label = "ratio (above 1 the skip wins)", .least = 0},
                    .series = {}});
}

}  // namespace dmpc::apps
