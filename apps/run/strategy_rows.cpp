#include "apps/run/strategy_rows.h"

#include <initializer_list>
#include <string>
#include <type_traits>
#include <utility>

#include "core/database/database.h"
#include "dataflow/packets.h"

namespace dmpc::apps {

namespace {

using dataflow::BalanceOptions;
using dataflow::RayOptions;
using svm::PageOptions;

constexpr const char* fetches_none = "nodes of the other strategies fetch no pages";
constexpr const char* works_on_region = "a node of dataflow works on the rays that come to its region";
constexpr const char* share_out_pixels = "the other strategies divide pixels, not space";
constexpr const char* rays_stay = "rays of the other strategies do not travel";

template <class T>
OptionSet::Choices<T> by_name(std::initializer_list<T> kinds) {
  OptionSet::Choices<T> all;
  for (const T kind : kinds) {
    all.emplace_back(name_of(kind), kind);
  }
  return all;
}

const PageOptions& pages_of(const svm::Plan& plan) { return plan.request.pages; }
const BalanceOptions& balance_of(const dataflow::Plan& plan) { return plan.request.rays.balance; }
OptionValue cuts_reported(const dataflow::Plan& plan) {
  const BalanceOptions& balance = balance_of(plan);
  return balance.balance == dataflow::Balance::scattered ? OptionValue() : name_of(balance.bsp.order);
}

template <class Row>
std::vector<Row> joined(std::vector<Row> rows, const std::vector<Row>& more) {
  rows.insert(rows.end(), more.begin(), more.end());
  return rows;
}

/// Rows about page placement.
std::vector<PageRow> rows_of_pages() {
  using svm::PageHomes;
  return {
      {.name = "--cache-pages",
       .takes = number<&PageOptions::cache_pages>(1, 0x7fffffff, "a quarter of the database; with --node-memory what it holds"),
       .help = "Pages of other nodes that a node can cache (svm)",
       .why = "nodes of the other strategies need no pages of other nodes",
       .key = "cache_pages",
       .reported = [](const svm::Plan& plan) -> OptionValue { return plan.frames; },
       .meaning = "of svm, as all up to count_pages; some of them of replicated and forest, too"},
      {.name = "--homes",
       .takes = word<&PageOptions::homes>(by_name({PageHomes::spread, PageHomes::host, PageHomes::tree})),
       .help = "Permanent place of the pages: spread: every node has a part. host: the host has all. tree: the host has all, and "
               "nodes ask their parents in a tree below it, of which the first that has the page replies (svm)",
       .why = fetches_none,
       .key = "homes",
       .reported = [](const svm::Plan& plan) -> OptionValue { return svm::name_of(pages_of(plan).homes); }},
      {.name = "--resident",
       .takes = number<&PageOptions::resident_percent>(0, 100, "0"),
       .help = "Percent of the cached pages that every node keeps permanently: those that a small picture uses most (svm)",
       .why = "nodes of the other strategies have no frames for pages",
       .key = "resident_pages",
       .reported = [](const svm::Plan& plan) -> OptionValue { return plan.resident_count; }},
      {.name = "--replacement",
       .takes = word<&PageOptions::replacement>(policy_choices()),
       .help = "Replacement policy of the page cache (svm): one of dmpc's, or with --runner=virtual one of your own, as a shared "
               "library or a class for Python, by its full path, which nobody but you and root can write",
       .why = "nodes of the other strategies cache no pages",
       .key = "replacement",
       .reported = [](const svm::Plan& plan) -> OptionValue { return svm::policy_name(pages_of(plan)); }},
  };
}

/// Rows about the assignment of pixels.
std::vector<PageRow> rows_of_pixels() {
  using svm::PixelShares, svm::WorkDonor;
  return {
      {.name = "--in-flight",
       .takes = number<&PageOptions::in_flight>(
           1, svm::in_flight_max, "64, replicated 16, forest 16 to 256, runner virtual 16, replicated 1, mpi up to 256"),
       .help = "Pixels that a node works on at once; on threads the rays of 16 are traced in a bundle, those of fewer one by one",
       .why = "a node of dataflow traces one ray at a time",
       .key = "in_flight",
       .reported = [](const svm::Plan& plan) -> OptionValue { return plan.in_flight; },
       .meaning = "pixels"},
      {.name = "--bundles",
       .takes = flag<&PageOptions::bundles_on_machines>(),
       .help = "Trace the rays of 16 pixels in bundles on a modelled machine, too: the same film in less of this computer's "
               "time, but with different look-ups, events and virtual times (svm)",
       .why = "the other strategies trace rays one by one on a modelled machine",
       .key = "bundles_on_machines",
       .reported = [](const svm::Plan& plan) -> OptionValue { return pages_of(plan).bundles_on_machines; },
       .meaning = "asked for"},
      {.name = "--work-item",
       .takes = number<&PageOptions::work_item_side>(0, 1024, "4, or 3 without bundles"),
       .help = "Side in pixels of the work item that a node gives to an idle one; 0: nodes give no work",
       .why = works_on_region,
       .key = "work_item",
       .reported = [](const svm::Plan& plan) -> OptionValue { return plan.work_item_side; },
       .meaning = "pixels a side; 0: a node keeps its pixels"},
      {.name = "--work-donor",
       .takes = word<&PageOptions::work_donor>(by_name({WorkDonor::ring, WorkDonor::host})),
       .help = "ring: nodes start with their parts of the picture and ask each other for work. host: they ask the host for each "
               "work item",
       .why = works_on_region,
       .key = "work_donor",
       .reported = [](const svm::Plan& plan) -> OptionValue { return svm::name_of(pages_of(plan).work_donor); }},
      {.name = "--pixels",
       .takes = word<&PageOptions::pixel_shares>(by_name({PixelShares::submaps, PixelShares::interleaved})),
       .help = "Pixels that a node starts with: submaps: a part of the picture. interleaved: every m-th pixel of every n-th "
               "line, on m x n nodes",
       .why = works_on_region,
       .key = "pixels",
       .reported = [](const svm::Plan& plan) -> OptionValue { return svm::name_of(pages_of(plan).pixel_shares); },
       .meaning = "how they are shared out"},
      {.name = "--workers",
       .takes = number<&PageOptions::worker_count>(1, nodes::node_count_max, "all nodes"),
       .help = "Nodes that render; the others provide memory, and serve pages or answer requests",
       .why = "every node of dataflow works on the rays that come to its region",
       .key = "workers",
       .reported = [](const svm::Plan& plan) -> OptionValue { return plan.worker_count; }},
      {.name = "--count-pages",
       .takes = flag<&PageOptions::count_pages>(),
       .help = "Count the distinct pages of each pixel for --stats (svm; takes memory and time)",
       .why = "the other strategies look up no pages",
       .key = "count_pages",
       .reported = [](const svm::Plan& plan) -> OptionValue { return pages_of(plan).count_pages; }},
  };
}

std::vector<BalanceRow> make_balance_rows() {
  using dataflow::Balance, dataflow::CutOrder;
  return {
      {.name = "--balance",
       .takes = word<&BalanceOptions::balance>(
           by_name({Balance::subsampled, Balance::equal_size, Balance::scattered, Balance::moving})),
       .help = "subsampled: regions of about equal load, estimated by a subsampled picture. equal-size: regions of equal size. "
               "scattered: a lattice of many regions per node, with neighbours on different nodes. moving: as subsampled, with "
               "several units per node that migrate while rays travel",
       .why = share_out_pixels,
       .key = "balance",
       .reported = [](const dataflow::Plan& plan) -> OptionValue { return name_of(balance_of(plan).balance); },
       .meaning = "of dataflow, as all that follow"},
      {.name = "--cuts",
       .takes = word<&BalanceOptions::bsp, &dataflow::BspOptions::order>(by_name({CutOrder::longer_axis, CutOrder::alternating})),
       .help = "How space is cut: across the longer side of a box, or along each axis in turn as in 1994",
       .why = share_out_pixels,
       .key = "cuts",
       .reported = cuts_reported},
      {.name = "--regions",
       .takes = number<&BalanceOptions::regions_a_node>(1, dataflow::Scattered::regions_max, "1"),
       .help = "Regions per node (--balance=scattered), or units of a node's region (--balance=moving)",
       .key = "regions_a_node",
       .reported = [](const dataflow::Plan& plan) -> OptionValue {
         return balance_of(plan).has_several_regions() ? balance_of(plan).regions_a_node : 1;
       }},
      {.name = "--subsample",
       .takes = number<&BalanceOptions::subsample>(1, 65'536, "8"),
       .help = "The subsampled picture, which estimates loads, has one pixel of every NxN",
       .why = share_out_pixels,
       .key = "subsample",
       .reported =
           [](const dataflow::Plan& plan) {
             return balance_of(plan).is_by_load() ? static_cast<std::uint64_t>(balance_of(plan).subsample) : OptionValue();
           }},
  };
}

/// Rows about packets of rays and their memory.
std::vector<RayRow> rows_of_packets() {
  return {
      {.name = "--ray-batch",
       .takes = number<&RayOptions::ray_batch>(
           1, dataflow::ray_batch_max, "what fills 4 KiB; 2 KiB without bundles or with --ray-slots; 1 KiB on modelled machines"),
       .help = "Maximum number of rays in a packet",
       .why = rays_stay,
       .key = "ray_batch",
       .reported = [](const dataflow::Plan& plan) -> OptionValue { return plan.ray_batch; },
       .meaning = "rays of a packet, the most"},
      {.name = "--ray-credits",
       .takes = number<&RayOptions::ray_credits>(0, dataflow::ray_credits_max, "4; up to 64 with few nodes and bundles"),
       .help = "Packets of rays that a node may have in transit to each other node; 0: all go through the host",
       .why = rays_stay,
       .key = "ray_credits",
       .reported = [](const dataflow::Plan& plan) { return plan.shares_slots() ? OptionValue() : plan.ray_credits; },
       .meaning = "packets"},
      {.name = "--ray-slots",
       .takes = number<&RayOptions::ray_slots>(1, dataflow::ray_slots_max, "64 with more than 128 nodes; otherwise credits"),
       .help = "Packets of rays from all other nodes that a node has room for; senders request this room. Not with --ray-credits",
       .why = rays_stay,
       .key = "ray_slots",
       .reported = [](const dataflow::Plan& plan) { return plan.shares_slots() ? plan.ray_slots : OptionValue(); },
       .meaning = "packets"},
  };
}

/// Rows about the processing of rays at a node.
std::vector<RayRow> rows_of_rays() {
  return {
      {.name = "--ray-queue",
       .takes =
           number<&RayOptions::queue_packets>(0, dataflow::queue_packets_max, "256; 512 without bundles; 128 with --ray-slots"),
       .help = "Packets of rays that can wait on a node for credit before further ones go through the host",
       .why = rays_stay,
       .key = "ray_queue",
       .reported = [](const dataflow::Plan& plan) -> OptionValue { return plan.queue_packets; },
       .meaning = "packets"},
      {.name = "--tested-objects",
       .takes = number<&RayOptions::tested_objects>(0, dataflow::tested_objects_max, ""),
       .help =
           "Leaves that a ray remembers as tested, so that other regions do not test them again; rays are then traced one by one",
       .why = rays_stay,
       .key = "tested_objects",
       .reported = [](const dataflow::Plan& plan) -> OptionValue { return plan.tested_objects(); }},
      {.name = "--no-backpressure",
       .takes = flag<&RayOptions::without_backpressure>(),
       .help = "Start primary rays even if a node's queue is full and the host buffers half a million rays, as in 1994",
       .why = rays_stay,
       .key = "backpressure",
       .reported = [](const dataflow::Plan& plan) -> OptionValue { return !plan.request.rays.without_backpressure; }},
  };
}

/// Returns a row's value in a plan; a flag that the strategy does not have is off.
template <class Options, class Plan, class OtherPlan>
OptionValue reported_of(const OptionRow<Options, Plan>& row, Strategy strategy, const OtherPlan& plan) {
  if constexpr (std::is_same_v<Plan, OtherPlan>) {
    const OptionValue value = row.reported(plan);
    return has(strategy, row) || std::holds_alternative<bool>(value) ? value : OptionValue();
  } else {
    return {};
  }
}

/// It has no option: the topology is the machine's.
constexpr std::string_view topology_key = "topology";

OptionValue topology_of(const svm::Plan&) { return {}; }
OptionValue topology_of(const dataflow::Plan& plan) { return name_of(*plan.request.rays.topology); }

/// The keys and their order are an interface.
template <class Reported>
std::vector<Reported> in_order(std::vector<Reported> reported) {
  const auto policy =
      std::find_if(reported.begin(), reported.end(), [](const Reported& each) { return each.key == "replacement"; });
  std::rotate(reported.begin() + 1, policy, policy + 1);
  return reported;
}

template <class Plan>
std::vector<ReportedOption> reported_by(Strategy strategy, const Plan& plan) {
  std::vector<ReportedOption> reported;
  for_each_row([&](const auto& row) { reported.push_back({row.key, reported_of(row, strategy, plan)}); });
  reported.push_back({topology_key, topology_of(plan)});
  return in_order(std::move(reported));
}

std::vector<OptionWord> make_strategy_words() {
  std::vector<OptionWord> words = {nodes_word, {core::field_of<&svm::PlanRequest::strategy>(), "--strategy"}, node_memory_word};
  const auto add = [&](const auto& row) { words.push_back({row.takes.field, row.name}); };
  std::for_each(database_rows().begin(), database_rows().end(), add);
  for_each_row(add);
  return words;
}

}  // namespace

OptionSet::Choices<svm::Replacement> policy_choices() {
  OptionSet::Choices<svm::Replacement> all;
  for (const svm::PolicyKind& kind : svm::policy_kinds()) {
    all.emplace_back(kind.name, static_cast<svm::Replacement>(all.size()));
  }
  return all;
}

const std::vector<PageRow>& page_rows() {
  static const std::vector<PageRow> rows = joined(rows_of_pages(), rows_of_pixels());
  return rows;
}

const std::vector<BalanceRow>& balance_rows() {
  static const std::vector<BalanceRow> rows = make_balance_rows();
  return rows;
}

const std::vector<RayRow>& ray_rows() {
  static const std::vector<RayRow> rows = joined(rows_of_packets(), rows_of_rays());
  return rows;
}

bool has(Strategy strategy, const PageRow& row) {
  const svm::Strategy* const with_pages = page_strategy(strategy);
  return with_pages != nullptr && svm::goes_with(row.takes.field, *with_pages);
}

const std::vector<OptionWord>& strategy_words() {
  static const std::vector<OptionWord> words = make_strategy_words();
  return words;
}

std::vector<ReportedKey> reported_keys() {
  std::vector<ReportedKey> keys;
  for_each_row([&](const auto& row) { keys.push_back({row.key, row.takes.kind, row.meaning}); });
  keys.push_back({topology_key, OptionKind::word, "onto which regions are mapped"});
  return in_order(std::move(keys));
}

std::vector<ReportedOption> reported_options(Strategy strategy, const svm::Plan& plan) { return reported_by(strategy, plan); }
std::vector<ReportedOption> reported_options(Strategy strategy, const dataflow::Plan& plan) {
  return reported_by(strategy, plan);
}

}  // namespace dmpc::apps
