#include "apps/run/strategy_options.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include "apps/frontend/line/option_values.h"
#include "apps/frontend/line/words.h"
#include "apps/frontend/machine/machines.h"
#include "apps/frontend/run/option_words.h"
#include "apps/policy/foreign_policy.h"
#include "apps/run/strategy_rows.h"
#include "core/base/expect.h"
#include "svm/forest/strategy.h"

namespace dmpc::apps {
namespace {

using core::UsageError;

struct StrategyKind {
  Strategy strategy;
  const char* name;
  const svm::Strategy* (*with_pages)();  ///< the strategy of the svm library
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

}  // namespace

const char* name_of(dataflow::Balance balance) {
  using dataflow::Balance;
  return balance == Balance::subsampled   ? "subsampled"
         : balance == Balance::equal_size ? "equal-size"
         : balance == Balance::scattered  ? "scattered"
                                          : "moving";
}

const char* name_of(dataflow::CutOrder order) { return order == dataflow::CutOrder::longer_axis ? "longer-side" : "alternating"; }

void check_regions(const OptionSet& options, const dataflow::BalanceOptions& balance) {
  using dataflow::Balance;
  if (options.is_given("--regions") && !balance.has_several_regions()) {
    throw core::UsageError("--regions goes with --balance=scattered or moving: else a node has one region");
  }
  if (balance.balance == Balance::moving && balance.regions_a_node < 2) {
    throw core::UsageError("--balance=moving needs --regions=K, at least 2 units per node, such as 16");
  }
  if (options.is_given("--cuts") && balance.balance == Balance::scattered) {
    throw core::UsageError("--cuts does not go with --balance=scattered: a lattice is not cut box by box");
  }
}

const char* name_of(Strategy strategy) { return kind_of(strategy).name; }

const svm::Strategy* page_strategy(Strategy strategy) { return kind_of(strategy).with_pages(); }

void add_nodes_option(OptionSet options, std::uint32_t& count, const std::string& standard) {
  options.add_number(nodes_word.option, count, 1, nodes::node_count_max, standard, "Number of nodes, each with its own memory");
}

void add_strategy_option(OptionSet options, Strategy& strategy) {
  OptionSet::Choices<Strategy> choices;
  for (const StrategyKind& kind : strategy_kinds) {
    choices.emplace_back(kind.name, kind.strategy);
  }
  options.add_choice("--strategy", strategy, choices,
                     "svm: the scene is distributed over the nodes and its pages travel. replicated: every node holds the whole "
                     "scene. dataflow: every node holds a region of space and rays travel. forest: every node holds the top of "
                     "the bounding volume hierarchy, and subtrees that other nodes query (--structure=extents)");
}

void add_memory_option(OptionSet options, std::optional<std::size_t>& node_memory_bytes) {
  const std::string name = node_memory_word.option;
  options.add_text(
      name, "SIZE|auto [auto]",
      [&node_memory_bytes, name](const std::string& text) {
        node_memory_bytes = text == "auto" ? std::nullopt : std::optional(parse_size_bytes(text, name));
      },
      "Limit of each node's memory, such as 4MiB");
}

void add_machine_option(OptionSet options, std::string& machine_name, const std::string& when) {
  options.add_text(
      "--machine", "MACHINE|FILE.json [ipsc2]", [&machine_name](const std::string& name) { machine_name = name; },
      "Machine to model" + when + ": " + machine_preset_names() + " or a file such as dmpc machine prints");
}

void add_page_options(OptionSet options, StrategyOptions& strategy, const std::string& in_flight_default) {
  options.begin_group("Strategies svm, replicated and forest");
  svm::PageOptions& pages = strategy.pages;
  for (const PageRow& row : page_rows()) {
    if (row.takes.field == core::field_of<&svm::PageOptions::replacement>()) {
      options.add_choice<svm::Replacement>(row.name, pages.replacement, policy_choices(),
                                           {.shown = ForeignPolicy::places,
                                            .take =
                                                [&strategy](const std::string& text) {
                                                  strategy.policy_place = ForeignPolicy::is_place(text) ? text : "";
                                                  return !strategy.policy_place.empty();
                                                }},
                                           row.help);
    } else if (row.takes.field == core::field_of<&svm::PageOptions::in_flight>()) {
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

void check_together(const OptionSet& options, const StrategyOptions& run) {
  for_each_row([&](const auto& row) {
    if (row.why != nullptr && !has(run.strategy, row) && options.is_given(row.name)) {
      throw UsageError(std::string(row.name) + " goes with " + joined(strategies_with(row), " or ") + ": " + row.why);
    }
  });
  check_regions(options, run.rays.balance);
  if (!run.policy_place.empty() && run.runner.kind != RunnerKind::virtual_time) {
    throw UsageError("--replacement=" + run.policy_place +
                     " goes with --runner=virtual: threads would wait for a policy of your own, and a modelled machine does not");
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
  if (!options.is_given("--structure") && !options.is_given("--system")) {  // a system sets the structure itself
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
