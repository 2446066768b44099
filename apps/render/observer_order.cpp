#include "apps/render/observer_order.h"

#include <algorithm>
#include <limits>

#include "apps/frontend/run/time_parts.h"
#include "apps/run/report.h"
#include "core/base/expect.h"
#include "dataflow/packets.h"
#include "nodes/flat_bytes.h"
#include "nodes/ranks/rank_links.h"
#include "svm/pages/packets.h"

namespace dmpc::apps {

namespace {

std::uint32_t rank_count_of(const RenderOptions& options) {
  return options.computer.ranks == nullptr ? 1 : options.computer.ranks->rank_count();
}

/// The packets of which a page says who got how many from whom.
std::uint32_t pair_kinds(Strategy strategy) {
  switch (strategy) {
    case Strategy::svm:
      return 1U << number_of(svm::Kind::page_reply);
    case Strategy::dataflow:
      return 1U << number_of(dataflow::Kind::rays) | 1U << number_of(dataflow::Kind::forwarded);
    default:
      return 0;
  }
}

/// Kinds for files and for a page, which are all cheap. Different pages are not among them, since they would take memory of the
/// nodes.
std::vector<core::HeatKind> heat_kinds_of(const RenderOptions& options) {
  using core::HeatKind;
  std::vector<HeatKind> kinds = kinds_of(options.heat_maps);
  if (options.report) {
    kinds.insert(kinds.end(), {HeatKind::done, HeatKind::node, HeatKind::rays});
    if (options.strategy == Strategy::svm) {
      kinds.insert(kinds.end(), {HeatKind::faults, HeatKind::references});
    }
    if (options.computer.machine) {
      kinds.push_back(HeatKind::time);  // with threads the clock would be read twice a quantum
    }
  }
  return kinds;
}

}  // namespace

ObserverOrder observer_order(const RenderOptions& options, std::uint32_t page_count, std::uint32_t pixel_count,
                             std::size_t references_max) {
  const std::uint32_t node_count = options.computer.node_count;
  ObserverOrder order{.node_count = node_count,
                      .page_count = page_count,
                      .pixel_count = pixel_count,
                      .heat_kinds = heat_kinds_of(options),
                      .has_profile = options.report.has_value(),
                      .wait_of = wait_of(wait_kinds(options.strategy)),
                      .follows_paths = options.report && options.computer.machine};
  if (options.report && options.computer.machine) {
    const nodes::Machine& machine = *options.computer.machine;
    order.exchange = {.node_count = node_count,
                      .topology = machine.topology,
                      .uplinks = machine.uplinks,
                      .pair_kinds = pair_kinds(options.strategy),
                      .number_count = options.strategy == Strategy::svm ? page_count : 0};
  }
  if (options.trace.path) {
    order.trace = trace_choice(options.trace);
    order.trace->events_max = std::max<std::uint64_t>(1, order.trace->events_max / rank_count_of(options));
  }
  if (options.report && options.strategy == Strategy::svm) {
    order.fetches = options.pages.homes;
    if (!counts_pages(options)) {
      order.references_max = references_of_node(node_count, references_max);
    }
  }
  if (options.references) {
    order.references_max = std::numeric_limits<std::size_t>::max();
    order.has_all_references = true;
  }
  return order;
}

std::string bytes_of(const ObserverOrder& order) {
  nodes::FlatWriter flat;
  flat.put(order.node_count, order.page_count, order.pixel_count, order.trace, order.has_profile, order.wait_of, order.fetches,
           order.references_max, order.has_all_references);
  flat.put_all(order.heat_kinds);
  return flat.take();
}

ObserverOrder observer_order_from(std::string_view bytes) {
  nodes::FlatReader flat(bytes);
  ObserverOrder order;
  flat.take_into(order.node_count, order.page_count, order.pixel_count, order.trace, order.has_profile, order.wait_of,
                 order.fetches, order.references_max, order.has_all_references);
  order.heat_kinds = flat.take_all<core::HeatKind>();
  core::expect(flat.is_at_end(), "an order is read to its end");
  return order;
}

}  // namespace dmpc::apps
