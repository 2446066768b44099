#include "dataflow/run.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "core/base/expect.h"
#include "core/trace/work.h"
#include "dataflow/frames.h"
#include "dataflow/packets.h"
#include "dataflow/regions/mapping.h"

namespace dmpc::dataflow {
namespace {

/// Reports by pixel need single rays, and the nodes of a modelled machine compute as those of the article did.
bool walks_in_bundles(const RunOptions& options) { return !options.computer.machine && !options.watching.is_metered(); }

/// Work assigned before the start would have to be finished before anything can be kept.
bool is_assigned_on_the_way(const RunOptions& options) {
  return options.are_frames || options.continuation.start != nullptr || options.continuation.keep;
}

/// The sum for each node of a quantity given by region.
std::vector<double> by_node(const Regions& regions, const std::vector<double>& by_region) {
  std::vector<double> loads(regions.node_count());
  for (std::uint32_t index = 0; index < by_region.size(); ++index) {
    loads[nodes::index_of(regions.owner_at(index))] += by_region[index];
  }
  return loads;
}

/// The assignment of regions to nodes, with each node's predicted load if there is one. `loads` are those of a subsampled
/// picture, if regions are made from one.
Balanced regions_for(std::uint32_t node_count, const ColumnLoads& loads, const core::RenderSettings& settings,
                     const RunOptions& options) {
  if (options.make_regions) {
    return {options.make_regions(node_count), {}};
  }
  Balanced balanced = share_out(loads, node_count, options.rays.balance);
  if (Bsp* const bsp = balanced.regions.bsp(); bsp != nullptr && options.rays.topology) {
    map_onto(*bsp, *options.rays.topology, axes_facing(settings.camera));
  }
  const bool is_predicted = options.rays.balance.is_by_load();
  balanced.predicted = is_predicted ? by_node(balanced.regions, balanced.predicted) : std::vector<double>();
  return balanced;
}

Plan plan_for(const Distribution& distribution, const core::Database& database, const ColumnLoads& loads,
              const core::RenderSettings& settings, const RunOptions& options, const std::stop_token& stop) {
  const PlanRequest request = plan_request(distribution.shares(), settings, options);
  const MakeShares make_shares = [&](std::uint32_t node_count) {
    if (!options.make_regions && !can_share_out(loads.lattice, node_count, options.rays.balance)) {
      return std::vector<Share>();
    }
    Regions regions = regions_for(node_count, loads, settings, options).regions;
    const MeasuredParts parts = measure_parts(database, settings, regions);
    return measure_shares(settings, std::span(&regions, 1), std::span(&parts, 1), stop, !is_assigned_on_the_way(options),
                          request.pixel_order())
        .front();
  };
  return make_plan(request, [&] { return smallest_node_count(request, make_shares); });
}

}  // namespace

Gather::Counters Report::gathers() const {
  Gather::Counters sum;
  for (const NodeReport& node : nodes) {
    sum += node.program.gather;
  }
  return sum;
}

std::vector<double> Report::work() const {
  std::vector<double> work;
  for (const NodeReport& node : nodes) {
    work.push_back(static_cast<double>(work_of(node.program.operations)));
  }
  return work;
}

std::vector<std::uint64_t> Report::ray_matrix() const {
  std::vector<std::uint64_t> matrix(nodes.size() * nodes.size());
  for (const Flow& flow : ray_flows()) {
    matrix[flow.first * nodes.size() + flow.second] = flow.amount;
  }
  return matrix;
}

std::vector<Flow> Report::ray_flows() const {
  std::vector<Flow> flows;
  for (std::uint32_t from = 0; from < nodes.size(); ++from) {
    for (const SentToOwner& sent : nodes[from].program.pairs) {
      core::expect(sent.owner != from && sent.owner < nodes.size(), "rays are sent to another node");
      flows.push_back({from, sent.owner, sent.rays_total()});
    }
  }
  return flows;
}

double Report::messages_per_ray() const {
  const std::uint64_t shot = operations().ray_count();
  return shot == 0 ? 0.0 : static_cast<double>(rays().sent()) / static_cast<double>(shot);
}

double Report::mean_fill() const { return gathers().mean_fill(plan.ray_batch); }

nodes::Traffic ray_traffic(const nodes::TrafficByKind& by_kind) {
  nodes::Traffic sum;
  for (const Kind kind : {Kind::rays, Kind::overflow, Kind::forwarded}) {
    sum += by_kind[number_of(kind)];
  }
  return sum;
}

PlanRequest plan_request(std::vector<Share> shares, const core::RenderSettings& settings, const RunOptions& options) {
  return {.shares = std::move(shares),
          .computer = options.computer,
          .rays = options.rays,
          .depth_max = static_cast<std::uint32_t>(core::ray_depth_max(settings.shade, settings.header, settings.skips)),
          .waiting_hits_max = static_cast<std::uint32_t>(core::waiting_hits_max(settings.shade, settings.skips)),
          .width = static_cast<std::uint32_t>(settings.camera.width()),
          .height = static_cast<std::uint32_t>(settings.camera.height()),
          .first_samples = settings.first_samples().count,
          .refinement = settings.refinement,
          .is_assigned_on_the_way = is_assigned_on_the_way(options),
          .bundles = settings.skips.bundles && options.rays.tested_objects == 0 && walks_in_bundles(options),
          .has_instances = settings.header.has_instances != 0};
}

Prepared prepare(const core::Database& database, const core::RenderSettings& settings, const RunOptions& options,
                 const std::stop_token& stop) {
  const ColumnLoads loads = column_loads(database, settings, options.rays.balance, stop);
  Balanced balanced = regions_for(options.computer.node_count, loads, settings, options);
  Prepared prepared{.distribution = distribute(database, settings, balanced.regions, stop, !is_assigned_on_the_way(options),
                                               plan_request({}, settings, options).pixel_order()),
                    .predicted = std::move(balanced.predicted),
                    .detail = settings.fine_detail(database)};
  prepared.duplication = prepared.distribution.duplication(database);
  prepared.plan = plan_for(prepared.distribution, database, loads, settings, options, stop);
  return prepared;
}

std::vector<nodes::NodeSpecification> specifications_without_host(const Plan& plan, const MakeProgram& make_program) {
  return pictures::specifications_without_host(plan, make_program, nodes::batching_of(number_of(Kind::film), plan.film_credits));
}

std::vector<nodes::NodeSpecification> specifications_of(const Plan& plan, const Distribution& distribution,
                                                        const core::RenderSettings& settings, core::Film& film,
                                                        const RunOptions& options, const std::stop_token& stop,
                                                        const core::FineDetail* detail) {
  const MakeProgram make_program = [&](std::uint32_t index, nodes::Node& node) {
    const core::DatabasePart& part = distribution.parts[index];
    return make_node_program(
        node, plan,
        NodeAssignment{part.header, std::span(part.bytes), distribution.primaries[index], settings, distribution.regions,
                       distribution.proxy, distribution.pages[index], distribution.runs_of_unit[index]},
        nodes::meter_for(options.watching, options.computer, node.id()));
  };
  std::vector<nodes::NodeSpecification> specifications = specifications_without_host(plan, make_program);
  const auto assign = [&settings, &distribution, stop, order = plan.request.pixel_order()](const core::Pass& pass,
                                                                                           const core::PixelMask& done) {
    std::optional runs = assign_primaries(settings, distribution.regions, pass, done, stop, order);
    return stop.stop_requested() ? std::nullopt : std::move(runs);
  };
  const auto make_host = [&, assign, detail](nodes::Node& node) {
    return std::make_unique<HostProgram>(node, plan, film, options.watching.progress, assign, options.continuation, detail);
  };
  specifications.back().make_program = make_host;
  return specifications;
}

Report run_prepared(const Prepared& prepared, const core::RenderSettings& settings, const RunOptions& options,
                    std::stop_token stop) {
  return Frames(prepared, settings, options, stop).render(std::move(stop));
}

Report run_dataflow(const core::Database& database, const core::RenderSettings& settings, const RunOptions& options,
                    std::stop_token stop) {
  return run_prepared(prepare(database, settings, options, stop), settings, options, std::move(stop));
}

}  // namespace dmpc::dataflow
