#include "apps/run/strategy_options.h"

#include <algorithm>
#include <vector>

#include "apps/edge/line/option_values.h"
#include "apps/edge/machine/machines.h"
#include "apps/run/region_options.h"
#include "core/base/expect.h"
#include "dataflow/packets.h"
#include "dataflow/plan.h"
#include "svm/plan.h"

namespace dmpc::apps {

namespace {

using core::UsageError;

/// An option that only some strategies have, and why.
struct Belonging {
  const char* option;
  std::vector<Strategy> strategies;
  const char* reason;

  bool has(Strategy strategy) const { return std::find(strategies.begin(), strategies.end(), strategy) != strategies.end(); }
  std::string names() const {
    std::string names;
    for (const Strategy strategy : strategies) {
      names += std::string(names.empty() ? "" : " or ") + "--strategy=" + name_of(strategy);
    }
    return names;
  }
};

const std::vector<Belonging>& belongings() {
  static const std::vector<Strategy> of_pixels = {Strategy::svm, Strategy::replicated,
                                                  Strategy::forest};  // whose nodes have them
  static const std::vector<Belonging> all = {
      {"--cache-pages", {Strategy::svm}, "a node of the others needs no page of another node"},
      {"--homes", {Strategy::svm}, "a node of the others fetches no page"},
      {"--tree-arity", {Strategy::svm}, "a node of the others fetches no page"},
      {"--resident", {Strategy::svm}, "a node of the others has no frames for pages"},
      {"--replacement", {Strategy::svm}, "a node of the others keeps no page of another node"},
      {"--count-pages", {Strategy::svm}, "the others look up no pages"},
      {"--in-flight", of_pixels, "a node of dataflow traces one ray at a time"},
      {"--work-item", of_pixels, "a node of dataflow works on what comes to its region"},
      {"--work-giver", of_pixels, "a node of dataflow works on what comes to its region"},
      {"--pixels", of_pixels, "a node of dataflow works on what comes to its region"},
      {"--workers", of_pixels, "every node of dataflow works on what comes to its region"},
      {"--balance", {Strategy::dataflow}, "the others share out pixels, not space"},
      {"--cuts", {Strategy::dataflow}, "the others share out pixels, not space"},
      {"--subsample", {Strategy::dataflow}, "the others share out pixels, not space"},
      {"--balance-grid", {Strategy::dataflow}, "the others share out pixels, not space"},
      {"--ray-batch", {Strategy::dataflow}, "rays of the others do not travel"},
      {"--ray-credits", {Strategy::dataflow}, "rays of the others do not travel"},
      {"--ray-places", {Strategy::dataflow}, "rays of the others do not travel"},
      {"--tested-objects", {Strategy::dataflow}, "rays of the others do not travel"},
      {"--ray-queue", {Strategy::dataflow}, "rays of the others do not travel"},
      {"--no-backpressure", {Strategy::dataflow}, "rays of the others do not travel"},
      {"--topology", {Strategy::dataflow}, "the others map no regions onto nodes"},
  };
  return all;
}

void check_strategy(const OptionSet& options, const StrategyOptions& run) {
  for (const Belonging& belonging : belongings()) {
    if (options.is_given(belonging.option) && !belonging.has(run.strategy)) {
      throw UsageError(std::string(belonging.option) + " goes with " + belonging.names() + ": " + belonging.reason);
    }
  }
  check_homes(options, run.pages.homes);
  check_regions(options, run.rays.balance);
}

}  // namespace

const char* name_of(Strategy strategy) {
  switch (strategy) {
    case Strategy::svm:
      return "svm";
    case Strategy::replicated:
      return "replicated";
    case Strategy::dataflow:
      return "dataflow";
    case Strategy::forest:
      return "forest";
  }
  core::expect(false, "a strategy has a name");
  return "";
}

void add_strategy_option(OptionSet options, Strategy& strategy) {
  options.add_choice<Strategy>(
      "--strategy", strategy,
      {{"svm", Strategy::svm},
       {"replicated", Strategy::replicated},
       {"dataflow", Strategy::dataflow},
       {"forest", Strategy::forest}},
      "svm: the scene is spread over the nodes and its pages travel. replicated: every node holds it all. dataflow: every node "
      "holds a region of space and rays travel. forest: every node holds the top of the tree of boxes, and subtrees about which "
      "others ask (--structure=extents)");
}

void add_memory_option(OptionSet options, std::optional<std::size_t>& node_memory_bytes) {
  const auto take = [&node_memory_bytes](const std::string& text) {
    node_memory_bytes = text == "auto" ? std::nullopt : std::optional(parse_size_bytes(text, "--node-memory"));
  };
  options.add_text("--node-memory", "SIZE|auto [auto]", take, "Bound of each node's memory, such as 4MiB");
}

void add_machine_options(OptionSet options, RunnerOptions& runner, const std::string& when) {
  options.add_text(
      "--machine", "MACHINE|FILE.json [ipsc2]", [&runner](const std::string& name) { runner.machine_name = name; },
      "The machine that is modelled" + when + ": " + machine_preset_names() + " or a file such as dmpc machine prints");
  options.add_flag("--no-contention", runner.no_contention, "A link carries any number of messages at once" + when);
  options.add_flag("--memory-port", runner.memory_port,
                   "A node sends one message at a time and receives one at a time, over whatever links" + when);
}

void add_homes_options(OptionSet options, svm::PageHomes& homes, std::uint32_t& tree_arity) {
  using svm::PageHomes;
  options.add_choice<PageHomes>("--homes", homes,
                                {{"spread", PageHomes::spread}, {"host", PageHomes::host}, {"tree", PageHomes::tree}},
                                "Who keeps the pages for good: all nodes, each its part, or the host; tree: the host, and nodes "
                                "ask their parents in a tree below it, of which the first that has the page replies (svm)");
  options.add_number("--tree-arity", tree_arity, 1, nodes::node_count_max, std::to_string(svm::default_tree_arity),
                     "Children of the host, and of each node, with --homes=tree");
}

void check_homes(const OptionSet& options, svm::PageHomes homes) {
  if (options.is_given("--tree-arity") && homes != svm::PageHomes::tree) {
    throw UsageError("--tree-arity goes with --homes=tree: other homes are asked directly");
  }
}

void add_page_options(OptionSet options, svm::PageOptions& pages, const std::string& in_flight_default) {
  options.begin_group("Strategies svm, replicated and forest");
  options.add_number("--cache-pages", pages.cache_pages, 1, 0x7fffffff,
                     "a quarter of the database; with --node-memory what it holds",
                     "Pages of other nodes that a node can keep (svm)");
  add_homes_options(options, pages.homes, pages.tree_arity);
  options.add_number("--resident", pages.resident_percent, 0, 100, "0",
                     "Percent of those that every node keeps for good: what a small picture uses most (svm)");
  std::vector<std::pair<std::string, svm::Replacement>> policies;
  for (const svm::PolicyKind& kind : svm::policy_kinds()) {
    policies.emplace_back(kind.name, static_cast<svm::Replacement>(policies.size()));
  }
  options.add_choice<svm::Replacement>("--replacement", pages.replacement, policies,
                                       "Which of them makes room for another (svm)");
  options.add_number("--in-flight", pages.in_flight, 1, svm::in_flight_max, in_flight_default,
                     "Pixels that a node works on at once; on threads the rays of 16 walk together, of fewer alone");
  options.add_number("--work-item", pages.work_item_side, 0, 1024, "4, or 3 if rays walk alone",
                     "Side in pixels of what a node gives to an idle one; 0: nothing is given");
  using svm::WorkGiver;
  options.add_choice<WorkGiver>("--work-giver", pages.work_giver, {{"ring", WorkGiver::ring}, {"host", WorkGiver::host}},
                                "ring: nodes start with their parts of the picture and ask each other; host: for each item they "
                                "ask the host");
  using svm::PixelShares;
  options.add_choice<PixelShares>(
      "--pixels", pages.pixel_shares, {{"submaps", PixelShares::submaps}, {"interleaved", PixelShares::interleaved}},
      "submaps: a node starts with a part of the picture. interleaved: with every m-th pixel of every n-th line, on m x n nodes");
  options.add_number("--workers", pages.worker_count, 1, nodes::node_count_max, "all nodes",
                     "Nodes that render; the others lend their memories, and serve pages or answer");
}

void add_ray_options(OptionSet options, dataflow::RayOptions& rays) {
  options.begin_group("Strategy dataflow");
  add_balance_option(options, rays.balance.balance);
  add_cuts_option(options, rays.balance.bsp.order);
  add_scattered_option(options, rays.balance);
  add_region_options(options, rays.balance);
  options.add_number("--ray-batch", rays.ray_batch, 1, dataflow::ray_batch_max,
                     "what fills 4 KiB; 2 KiB if rays walk alone, modelled machines 1 KiB", "Rays in a packet, at most");
  options.add_number("--ray-credits", rays.ray_credits, 0, dataflow::ray_credits_max,
                     "4; up to 64 of few nodes whose rays walk together",
                     "Packets of rays that each node may have under way to each other; 0: all go by way of the host");
  options.add_number(
      "--ray-places", rays.ray_places, 1, dataflow::ray_places_max, "64 of more than 128 nodes; else credits",
      "Packets of rays from all others that each node has room for, and that they ask for; not with --ray-credits");
  options.add_number("--ray-queue", rays.queue_packets, 0, dataflow::queue_packets_max,
                     "256; 512 if rays walk alone; 128 with --ray-places",
                     "Packets of rays that can wait on a node for credit before more go by way of the host");
  options.add_number("--tested-objects", rays.tested_objects, 0, dataflow::tested_objects_max, "",
                     "Blocks that a ray remembers to have tested, so that other regions need not; rays then walk alone");
  options.add_flag("--no-backpressure", rays.without_backpressure,
                   "Nodes start primary rays whatever waits, as in 1994: what a full queue leaves goes by way of the host");
}

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
    throw UsageError("--structure=grid does not go with --strategy=forest: its nodes share one tree of boxes");
  }
  if (strategy == Strategy::forest && build.record_order != core::RecordOrder::spatial) {
    throw UsageError("--record-order=scattered does not go with --strategy=forest: a subtree lies in one page");
  }
}

}  // namespace dmpc::apps
