#include "apps/lab/bench/speed/ablation_table.h"

#include <utility>

#include "apps/edge/table/averages.h"
#include "apps/edge/table/filled_columns.h"
#include "apps/lab/bench/speed/table.h"
#include "apps/lab/bench/speed/verdict.h"

namespace dmpc::apps {
namespace {

std::string kind_of(const Ablation& ablation) {
  return ablation.is_control() ? "noise" : ablation.is_exact() ? "exact" : "bounded";
}

const FilledColumns<Ablation>& ablation_columns() {
  using A = Ablation;
  static const FilledColumns<A> columns = {
      {{"scene"}, [](const A& a) { return a.seconds.scene; }},
      {{"skip"}, [](const A& a) { return a.seconds.what; }},
      {{"kind"}, kind_of},
      {{"strategy"}, [](const A& a) { return a.seconds.detail; }},
      {{"nodes"}, [](const A& a) { return std::uint64_t{a.seconds.threads}; }},
      {{"processor time with it", "s", 3}, [](const A& a) { return median(a.seconds.rival_figures); }},
      {{"without over with", "", 3}, [](const A& a) { return ratio_of(a.seconds).median; }},
      {{"least", "", 3}, [](const A& a) { return ratio_of(a.seconds).least; }},
      {{"largest", "", 3}, [](const A& a) { return ratio_of(a.seconds).most; }},
      {{"counted work", "", 3}, &A::work_ratio},
      {{"avoided"}, [](const A& a) { return cell_of(a.avoided); }},
      {{"avoided what"}, &A::unit},
      {{"root mean square error", "1/255", 4}, [](const A& a) { return a.error ? Cell(255 * *a.error) : Cell(); }},
      {{"here"}, only_if([](const A& a) { return !a.is_control(); }, [](const A& a) { return text_of(verdict_on(a)); })}};
  return columns;
}

}  // namespace

Table table_of(std::span<const Ablation> ablations, const std::string& title) {
  Table table = filled_table(title, ablation_columns(), ablations);
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
