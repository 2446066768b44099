#include "apps/run/strategy_options.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include "apps/edge/machine/machines.h"
#include "apps/run/region_options.h"
#include "apps/run/strategy_rows.h"
#include "core/base/expect.h"
#include "svm/forest/strategy.h"

namespace dmpc::apps {

namespace {

using core::UsageError;

struct StrategyKind {
  Strategy strategy;
  const char* name;
  const svm::Strategy* (*with_pages)();  ///< what svm's library has for it
};
constexpr StrategyKind strategy_kinds[] = {
    {Strategy::svm, "svm", svm::svm_strategy},
    {Strategy::replicated, "replicated", svm::replicated_strategy},
    {Strategy::dataflow, "dataflow", [] { return static_cast<const svm::Strategy*>(nullptr); }},
    {Strategy::forest, "forest", svm::forest_strategy}};

const StrategyKind& kind_of(Strategy strategy) {
  const auto* const kind = std::find_if(std::begin(strategy_kinds), std::end(strategy_kinds),
                                        [&](const StrategyKind& each) { return each.strategy == strategy; });
  core::expect(kind != std::end(strategy_kinds), "a strategy has a name");
  return *kind;
}

template <class Row>
std::vector<std::string> strategies_with(const Row& row) {
  std::vector<std::string> names;
  for (const StrategyKind& kind : strategy_kinds) {
    if (has(kind.strategy, row)) {
      names.push_back(std::string("--strategy=") + kind.name);
    }
  }
  return names;
}

template <class Row>
const Row& row_of(const std::vector<Row>& rows, const core::Field& field) {
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const Row& each) { return each.takes.field == field; });
  core::expect(row != rows.end(), "a field that an option sets has a row");
  return *row;
}

std::string joined_by_or(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) {
    text += (text.empty() ? "" : " or ") + word;
  }
  return text;
}

/// Names, of several that do not go with the strategy, the first one that fewest strategies have; and what rays remember rather
/// than where they wait.
void check_strategy(const OptionSet& options, const StrategyOptions& run) {
  constexpr core::Field waiting = core::field_of<&dataflow::RayOptions::queue_packets>(),
                        remembered = core::field_of<&dataflow::RayOptions::tested_objects>();
  std::size_t fewest = std::size(strategy_kinds);
  core::Field named("");
  std::string sentence;
  for_each_row([&](const auto& row) {
    if (row.why == nullptr || has(run.strategy, row) || !options.is_given(row.name)) {
      return;
    }
    const std::vector<std::string> strategies = strategies_with(row);
    if (strategies.size() < fewest || (named == waiting && row.takes.field == remembered)) {
      fewest = strategies.size();
      named = row.takes.field;
      sentence = std::string(row.name) + " goes with " + joined_by_or(strategies) + ": " + row.why;
    }
  });
  if (!sentence.empty()) {
    throw UsageError(sentence);
  }
  check_homes(options, run.pages.homes);
  check_regions(options, run.rays.balance);
}

}  // namespace

const char* name_of(Strategy strategy) { return kind_of(strategy).name; }

const svm::Strategy* page_strategy(Strategy strategy) { return kind_of(strategy).with_pages(); }

void add_strategy_option(OptionSet options, Strategy& strategy) { strategy_row().add_to(options, strategy); }

void add_memory_option(OptionSet options, std::optional<std::size_t>& node_memory_bytes) {
  memory_row().add_to(options, node_memory_bytes);
}

void add_machine_options(OptionSet options, RunnerOptions& runner, const std::string& when) {
  options.add_text(
      "--machine", "MACHINE|FILE.json [ipsc2]", [&runner](const std::string& name) { runner.machine_name = name; },
      "The machine that is modelled" + when + ": " + machine_preset_names() + " or a file such as dmpc machine prints");
  options.add_flag("--no-contention", runner.no_contention, "A link carries any number of messages at once" + when);
  options.add_flag("--memory-port", runner.memory_port,
                   "A node sends one message at a time and receives one at a time, over whatever links" + when);
}

void check_homes(const OptionSet& options, svm::PageHomes homes) {
  if (options.is_given("--tree-arity") && homes != svm::PageHomes::tree) {
    throw UsageError("--tree-arity goes with --homes=tree: other homes are asked directly");
  }
}

void add_page_options(OptionSet options, svm::PageOptions& pages, const std::string& in_flight_default) {
  options.begin_group("Strategies svm, replicated and forest");
  for (const PageRow& row : page_rows()) {
    if (row.takes.field == core::field_of<&svm::PageOptions::in_flight>()) {
      row.add_to(options, pages, in_flight_default);
    } else if (row.takes.field != core::field_of<&svm::PageOptions::count_pages>()) {
      row.add_to(options, pages);
    }
  }
}

void add_ray_options(OptionSet options, dataflow::RayOptions& rays) {
  options.begin_group("Strategy dataflow");
  add_balance_options(options, rays.balance);
  for (const RayRow& row : ray_rows()) {
    row.add_to(options, rays);
  }
}

void add_balance_options(OptionSet options, dataflow::BalanceOptions& balance) {
  for (const BalanceRow& row : balance_rows()) {
    row.add_to(options, balance);
  }
}

void add_option(OptionSet options, const core::Field& field, svm::PageOptions& pages) {
  row_of(page_rows(), field).add_to(options, pages);
}

void add_option(OptionSet options, const core::Field& field, dataflow::BalanceOptions& balance) {
  row_of(balance_rows(), field).add_to(options, balance);
}

void add_topology_option(OptionSet options, nodes::TopologyKind& topology) { topology_row().add_to(options, topology); }

void check_together(const OptionSet& options, const StrategyOptions& run) {
  check_strategy(options, run);
  if (run.runner.no_contention && run.runner.memory_port) {
    throw UsageError("--memory-port does not go with --no-contention: without contention no message waits for a port");
  }
}

DatabaseOptions usual_database(Strategy strategy) {
  DatabaseOptions database;
  if (strategy == Strategy::forest) {
    database.build.structure = core::Structure::extents;
    database.build.page_size_bytes = 4096;
  }
  return database;
}

void settle_database(const OptionSet& options, Strategy strategy, DatabaseOptions& database) {
  const core::BuildOptions usual = usual_database(strategy).build;
  core::BuildOptions& build = database.build;
  if (!options.is_given("--structure") && !options.is_given("--system")) {  // a system has one
    build.structure = usual.structure;
  }
  if (!options.is_given("--page-size")) {
    build.page_size_bytes = usual.page_size_bytes;
  }
  if (strategy == Strategy::forest && build.structure != core::Structure::extents) {
    throw UsageError(std::string("--structure=") + name_of(build.structure) +
                     " does not go with --strategy=forest: its nodes share one tree of boxes");
  }
  check_voxels(options, build);
  if (strategy == Strategy::forest && build.record_order != core::RecordOrder::spatial) {
    throw UsageError("--record-order=scattered does not go with --strategy=forest: a subtree lies in one page");
  }
}

}  // namespace dmpc::apps
