#include <algorithm>
#include <numeric>
#include <string>

#include "apps/frontend/show/stats/counters_json.h"
#include "apps/run/ray_hops.h"
#include "apps/show/counters.h"
#include "apps/show/stats/strategy.h"
#include "dataflow/packets.h"

namespace dmpc::apps {

namespace {

using nodes::TrafficByKind;

/// Events of the rays of one node, or of all, on their way.
struct Travel {
  dataflow::ProgramCounts counts;
  TrafficByKind sent;
};

std::uint64_t sum_of(const std::array<std::uint64_t, core::ray_kind_count>& by_kind) {
  return std::accumulate(by_kind.begin(), by_kind.end(), std::uint64_t{0});
}

double ratio(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

/// Returns null if regions do not move.
Json movement_json(const dataflow::MovementCounters& movement, const TrafficByKind& sent, bool is_moving) {
  if (!is_moving) {
    return {};
  }
  std::uint64_t bytes = 0;
  for (const dataflow::Kind kind : {dataflow::Kind::unit_page, dataflow::Kind::unit_primaries}) {
    bytes += sent[dataflow::number_of(kind)].bytes;
  }
  Json all = json_of(movement);
  all["bytes"] = bytes;
  return all;
}

Json travel_json(const Travel& travel, const dataflow::Plan& plan) {
  const dataflow::ProgramCounts& counts = travel.counts;
  const dataflow::Gather::Counters& gather = counts.gather;
  Json all = {{"rays_in", rays_json(counts.rays.in)},
              {"rays_out", rays_json(counts.rays.out)},
              {"messages_per_ray", ratio(sum_of(counts.rays.out), sum_of(counts.operations.rays))}};
  all.update(json_of(gather));
  all["mean_fill"] = gather.mean_fill(plan.ray_batch);
  all["bytes"] = dataflow::ray_traffic(travel.sent).bytes;
  all["overflow"] = json_of(gather, overflow_counters);
  all["overflow"]["share"] = ratio(gather.rays_overflowed, gather.rays);
  all.update(json_of(counts.rays));
  all["movement"] = movement_json(counts.movement, travel.sent, plan.is_moving());
  all.update(json_of(gather, queue_counters));
  all.update(json_of(counts));
  return all;
}

Travel travel_of(const dataflow::Report& report) {
  Travel all{
      {.operations = report.operations(), .rays = report.rays(), .gather = report.gathers(), .movement = report.movement()},
      report.sent()};
  for (const dataflow::NodeReport& node : report.nodes) {
    all.counts.backlog_high_water = std::max(all.counts.backlog_high_water, node.program.backlog_high_water);
  }
  return all;
}

/// `predicted` is empty if there is no prediction.
Json loads_json(const std::vector<double>& work, const std::vector<double>& predicted) {
  const auto total = [](const std::vector<double>& loads) { return std::accumulate(loads.begin(), loads.end(), 0.0); };
  const bool is_predicted = !predicted.empty();
  return {{"work_ps", total(work)},
          {"predicted_ps", is_predicted ? Json(total(predicted)) : Json()},
          {"average", dataflow::average_load(work)},
          {"average_predicted", is_predicted ? Json(dataflow::average_load(predicted)) : Json()}};
}

Json region_json(const dataflow::NodeReport& node) {
  return {{"low", node.region.low},           {"high", node.region.high},      {"regions", node.region_count},
          {"share", node.region_share},       {"part_bytes", node.part_bytes}, {"primitive_copies", node.primitive_copies},
          {"primary_rays", node.primary_rays}};
}

Json regions_json(const dataflow::Report& report) {
  std::uint64_t bytes = 0, copies = 0, rays = 0;
  for (const dataflow::NodeReport& node : report.nodes) {
    bytes += node.part_bytes;
    copies += node.primitive_copies;
    rays += node.primary_rays;
  }
  return {{"grid", report.regions.grid_size()},
          {"duplication", report.duplication},
          {"part_bytes", bytes},
          {"primitive_copies", copies},
          {"primary_rays", rays}};
}

/// Returns rows of senders, only for pairs of which one has sent the other a ray: mostly neighbours.
Json pairs_json(const dataflow::Report& report) {
  Json rows = Json::array();
  for (std::size_t from = 0; from < report.nodes.size(); ++from) {
    for (const dataflow::SentToOwner& sent : report.nodes[from].program.pairs) {
      const auto& rays = sent.rays;
      rows.push_back({from, sent.owner, rays[0], rays[1], rays[2], rays[3], sent.packets, sent.rays_overflowed, rays[4]});
    }
  }
  return {{"columns", {"from", "to", "primary", "reflected", "refracted", "shadow", "packets", "rays_overflowed", "scattered"}},
          {"rows", rows}};
}

Json mapping_json(const dataflow::Report& report, nodes::TopologyKind topology) {
  const RayHops hops = ray_hops_of(report, topology);
  return {{"topology", std::string(name_of(topology))}, {"mean_hops", hops.mean}, {"mean_hops_random", hops.mean_of_random}};
}

Json host_json(const dataflow::HostCounters& host) {
  return {{"rays_buffered_max", host.rays_buffered_max},
          {"buffered_bytes_max", host.buffered_bytes_max},
          {"token_rounds", host.token_rounds}};
}

}  // namespace

StrategyStats strategy_stats(const RenderOptions& options, const dataflow::Report& report) {
  const dataflow::Plan& plan = report.plan;
  const std::vector<double> work = report.work();
  StrategyStats stats{
      .all = {{"travel", travel_json(travel_of(report), plan)},
              {"load", loads_json(work, report.predicted)},
              {"regions", regions_json(report)},
              {"mapping", mapping_json(report, *options.rays.topology)},
              {"pairs", pairs_json(report)}},
      .chaos = {{"ray_credits", plan.ray_credits}, {"host_credits", plan.host_credits}, {"film_credits", plan.film_credits}},
      .host = host_json(report.host_rays),
      .packets_overflowed = report.gathers().packets_overflowed};
  for (std::size_t i = 0; i < report.nodes.size(); ++i) {
    const dataflow::NodeReport& node = report.nodes[i];
    stats.nodes.push_back(
        {{"travel", travel_json({node.program, node.counters.sent}, plan)},
         {"load", {{"work_ps", work[i]}, {"predicted_ps", report.predicted.empty() ? Json() : Json(report.predicted[i])}}},
         {"region", region_json(node)}});
  }
  return stats;
}

}  // namespace dmpc::apps
