#include "dataflow/run.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "core/base/expect.h"
#include "core/trace/work.h"
#include "dataflow/packets.h"
#include "dataflow/ranks.h"
#include "dataflow/regions/mapping.h"
#include "nodes/gathering.h"

namespace dmpc::dataflow {
namespace {

using nodes::TrafficByKind;

/// What is told pixel by pixel needs rays that walk alone; and the nodes of a modelled machine compute as those of the article
/// did.
bool walks_in_bundles(const RunOptions& options) { return !options.computer.machine && !options.watching.is_metered(); }

/// What was dealt before the start would have to be done before anything can be kept.
bool is_dealt_on_the_way(const RunOptions& options) { return options.continuation.start != nullptr || options.continuation.keep; }

/// What regions have, by number, summed up for each node.
std::vector<double> by_node(const Regions& regions, const std::vector<double>& by_region) {
  std::vector<double> loads(regions.node_count());
  for (std::uint32_t index = 0; index < by_region.size(); ++index) {
    loads[nodes::index_of(regions.owner_at(index))] += by_region[index];
  }
  return loads;
}

/// Regions on their nodes, and the predicted load of each node if there is one. `loads` are those of a subsampled picture, if
/// regions are made from one.
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
    return measure_shares(settings, std::span(&regions, 1), std::span(&parts, 1), stop, !is_dealt_on_the_way(options)).front();
  };
  return make_plan(request, [&] { return smallest_node_count(request, make_shares); });
}

/// Where a node's regions lie.
void report_regions(NodeReport& report, const Regions& regions, const std::vector<std::uint32_t>& indices) {
  const auto volume = [](const core::Region& box) {
    double product = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      product *= box.high[axis] - box.low[axis];
    }
    return product;
  };
  double cells = 0;
  report.region = regions.region_at(indices.front());
  report.region_count = static_cast<std::uint32_t>(indices.size());
  for (const std::uint32_t index : indices) {
    const core::Region box = regions.region_at(index);
    cells += volume(box);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      report.region.low[axis] = std::min(report.region.low[axis], box.low[axis]);
      report.region.high[axis] = std::max(report.region.high[axis], box.high[axis]);
    }
  }
  report.region_share = cells / volume({.high = regions.grid_size()});
}

/// Whether every credit of a node, or of the host, is back where it started.
bool has_its_credits(const nodes::Node& node, const Plan& plan) {
  const std::uint32_t host = plan.node_count(), self = nodes::index_of(node.id());
  for (std::uint32_t peer = 0; peer <= host; ++peer) {
    const bool with_host = self == host || peer == host;
    const std::uint32_t planned = self == peer ? 0 : with_host ? plan.host_credits : plan.ray_credits;
    const bool deals = self == host && peer < host;
    if (node.credits(nodes::NodeId{peer}, ray_channel) != planned ||
        (deals && node.credits(nodes::NodeId{peer}, film_channel) != plan.dealing_credits())) {
      return false;
    }
  }
  return true;
}

/// Adds what the node was dealt.
void report_share(NodeReport& report, const Distribution& distribution, std::uint32_t index, const Share& share) {
  report.part_bytes = share.part_bytes;
  report.primitive_copies = distribution.parts[index].primitive_copies;
  for (const PrimaryRun& run : distribution.primaries[index]) {
    report.primary_rays += run.count;
  }
}

std::uint64_t sum_of(const std::array<std::uint64_t, core::ray_kind_count>& by_kind) {
  std::uint64_t sum = 0;
  for (const std::uint64_t of_kind : by_kind) {
    sum += of_kind;
  }
  return sum;
}

void check_rays(const Report& report) {
  const RayCounters rays = report.rays();
  const core::Operations operations = report.operations();
  core::expect(operations.ray_count() == rays.ended, "every ray shot has ended");
  core::expect(rays.in == rays.out, "every ray sent was received, of every kind");
  core::expect(operations.shadings == operations.primary_hits + operations.secondary_hits, "each hit was claimed by one node");
  core::expect(report.host_rays.rays_in == report.gathers().rays_overflowed, "every ray that overflowed came to the host");
  core::expect(report.host_rays.rays_in == report.host_rays.rays_out, "every ray that overflowed was forwarded");
  core::expect(
      report.film.samples() - report.samples_found_done == operations.rays[static_cast<std::size_t>(core::RayKind::primary)],
      "every primary ray was shot");
}

/// Every unit that was handed over was taken, and each is one node's.
void check_units(const Report& report) {
  const MovementCounters sum = report.movement();
  core::expect(sum.units_given == sum.units_taken, "every unit that was handed over was taken");
  core::expect(sum.primaries_given == sum.primaries_taken, "every primary ray that was handed over was taken");
  core::expect(sum.asks == sum.refusals + sum.units_taken, "every question was answered, by a unit or a refusal");
  core::expect(sum.units == report.plan.unit_count(), "every unit is one node's");
}

void check_packets(const Report& report) {
  const TrafficByKind sent = report.sent(), received = report.received();
  for (std::size_t kind = 0; kind < sent.size(); ++kind) {
    core::expect(sent[kind].packets == received[kind].packets, "every packet sent was received, of every kind");
  }
  core::expect(sent[number_of(Kind::film)].packets == sent[number_of(Kind::film_acknowledgement)].packets,
               "every film packet was acknowledged");
  nodes::expect_nothing_lost(report.ranks);
}

void fill(Report& report, nodes::Runner& runner, const Distribution& distribution, const nodes::Watching& watching) {
  const std::uint32_t node_count = report.plan.node_count();
  GatheredReports gathered = gather_reports(runner, report.plan);
  report.ranks = nodes::gather_rank_figures(runner, report.plan, report.plan.request.computer.ranks, watching.elsewhere.adds());
  const std::vector<std::vector<std::uint32_t>> regions = distribution.regions.by_node();
  report.nodes = std::move(gathered.nodes);
  for (std::uint32_t i = 0; i < node_count; ++i) {
    report_share(report.nodes[i], distribution, i, report.plan.request.shares[i]);
    report_regions(report.nodes[i], distribution.regions, regions[i]);
  }
  report.host = runner.node(node_count).counters();
  const auto& host = dynamic_cast<const HostProgram&>(runner.program(node_count));
  report.host_rays = host.report();
  report.refinement = host.refinement().result();
  if (report.end == nodes::RunEnd::finished) {
    check_rays(report);
    check_units(report);
    check_packets(report);
    core::expect(gathered.are_credits_back, "every credit has come back, and every packet of primary rays was worked off");
    report.virtual_time = runner.virtual_report();
  }
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
  std::vector<std::uint64_t> matrix;
  for (const NodeReport& node : nodes) {
    for (const PairCounters& pair : node.program.pairs) {
      matrix.push_back(pair.rays_total());
    }
  }
  return matrix;
}

double Report::messages_per_ray() const {
  const std::uint64_t shot = operations().ray_count();
  return shot == 0 ? 0.0 : static_cast<double>(sum_of(rays().out)) / static_cast<double>(shot);
}

double Report::mean_fill() const { return gathers().mean_fill(plan.ray_batch); }

TrafficByKind Report::sent() const {
  TrafficByKind sum = core::total_of(nodes, [](const NodeReport& node) { return node.counters.sent; });
  return core::add_counts(sum, host.sent);
}

TrafficByKind Report::received() const {
  TrafficByKind sum = core::total_of(nodes, [](const NodeReport& node) { return node.counters.received; });
  return core::add_counts(sum, host.received);
}

nodes::Traffic ray_traffic(const TrafficByKind& by_kind) {
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
          .depth_max = static_cast<std::uint32_t>(core::ray_depth_max(settings.shade, settings.header)),
          .waiting_hits_max = static_cast<std::uint32_t>(core::waiting_hits_max(settings.shade)),
          .width = static_cast<std::uint32_t>(settings.camera.width()),
          .height = static_cast<std::uint32_t>(settings.camera.height()),
          .first_samples = settings.first_samples().count,
          .refinement = settings.refinement,
          .is_dealt_on_the_way = is_dealt_on_the_way(options),
          .bundles = settings.skips.bundles && options.rays.tested_objects == 0 && walks_in_bundles(options)};
}

Prepared prepare(const core::Database& database, const core::RenderSettings& settings, const RunOptions& options,
                 const std::stop_token& stop) {
  const ColumnLoads loads = column_loads(database, settings, options.rays.balance, stop);
  Balanced balanced = regions_for(options.computer.node_count, loads, settings, options);
  Prepared prepared{.distribution = distribute(database, settings, balanced.regions, stop, !is_dealt_on_the_way(options)),
                    .predicted = std::move(balanced.predicted),
                    .detail = settings.fine_detail(database)};
  prepared.duplication = prepared.distribution.duplication(database);
  prepared.plan = plan_for(prepared.distribution, database, loads, settings, options, stop);
  return prepared;
}

Report run_prepared(const Prepared& prepared, const core::RenderSettings& settings, const RunOptions& options,
                    std::stop_token stop) {
  const core::PartialPicture* const start = options.continuation.start;
  core::expect(start == nullptr || start->film.pixel_count() == settings.camera.pixel_count(),
               "what is gone on with is of the same picture");
  Report report{.film = start != nullptr
                            ? start->film
                            : core::Film(settings.camera.width(), settings.camera.height(), settings.shade.film_scale,
                                         core::planes_for(settings.first_samples().count)),
                .samples_found_done = start != nullptr ? start->samples_done() : 0,
                .plan = prepared.plan,
                .regions = prepared.distribution.regions,
                .predicted = prepared.predicted,
                .duplication = prepared.duplication};
  core::expect(options.watching.heat == nullptr || options.watching.heat->item_count() == report.film.pixel_count(),
               "a heat map is of the picture's size");
  if (options.computer.ranks != nullptr) {
    hand_out(report.plan, prepared.distribution, settings, options.watching.elsewhere.order, *options.computer.ranks);
  }
  const auto runner = nodes::make_runner(
      specifications_of(report.plan, prepared.distribution, settings, report.film, options, stop, &prepared.detail),
      options.computer, options.watching.observer);
  if (options.watching.distributed) {
    options.watching.distributed();
  }
  report.end = runner->run(std::move(stop));
  fill(report, *runner, prepared.distribution, options.watching);
  return report;
}

std::vector<nodes::NodeSpecification> specifications_without_host(const Plan& plan, const MakeProgram& make_program) {
  std::vector<nodes::NodeSpecification> specifications;
  for (std::uint32_t i = 0; i < plan.node_count(); ++i) {
    specifications.push_back({plan.node_memory(i), plan.node_mailbox,
                              [make_program, i](nodes::Node& node) { return make_program(i, node); }, plan.held_bytes, 0,
                              nodes::patience_of(number_of(Kind::film), plan.film_credits)});
  }
  specifications.push_back({plan.host_memory(), plan.host_mailbox, {}, plan.held_bytes});
  return specifications;
}

GatheredReports gather_reports(nodes::Runner& runner, const Plan& plan) {
  const std::uint32_t host = plan.node_count();
  GatheredReports gathered{.are_credits_back = !runner.is_here(host) || has_its_credits(runner.node(host), plan)};
  nodes::gather_nodes(
      runner, host,
      [&](std::size_t index, nodes::FlatWriter& told) {
        const ProgramReport program = dynamic_cast<const NodeProgram&>(runner.program(index)).report();
        told.put(static_cast<const ProgramCounts&>(program));
        told.put_all(program.pairs);
        told.put(nodes::figures_of(runner.node(index)));
        told.put(has_its_credits(runner.node(index), plan));
      },
      [&](std::size_t, nodes::FlatReader& told) {
        NodeReport& report = gathered.nodes.emplace_back();
        static_cast<ProgramCounts&>(report.program) = told.take<ProgramCounts>();
        report.program.pairs = told.take_all<PairCounters>();
        static_cast<nodes::NodeFigures&>(report) = told.take<nodes::NodeFigures>();
        gathered.are_credits_back = told.take<bool>() && gathered.are_credits_back;
      });
  return gathered;
}

std::vector<nodes::NodeSpecification> specifications_of(const Plan& plan, const Distribution& distribution,
                                                        const core::RenderSettings& settings, core::Film& film,
                                                        const RunOptions& options, const std::stop_token& stop,
                                                        const core::FineDetail* detail) {
  const MakeProgram make_program = [&](std::uint32_t index, nodes::Node& node) {
    const core::DatabasePart& part = distribution.parts[index];
    return make_node_program(
        node, plan,
        NodeDeal{part.header, std::span(part.bytes), distribution.primaries[index], settings, distribution.regions,
                 distribution.outline, distribution.pages[index], distribution.runs_of_unit[index]},
        nodes::meter_for(options.watching, options.computer, node.id()));
  };
  std::vector<nodes::NodeSpecification> specifications = specifications_without_host(plan, make_program);
  const auto deal = [&settings, &distribution, stop](const core::Pass& pass, const core::PixelMask& done) {
    std::optional runs = deal_primaries(settings, distribution.regions, pass, done, stop);
    return stop.stop_requested() ? std::nullopt : std::move(runs);
  };
  const auto make_host = [&, deal, detail](nodes::Node& node) {
    return std::make_unique<HostProgram>(node, plan, film, options.watching.progress, deal, options.continuation, detail);
  };
  specifications.back().make_program = make_host;
  return specifications;
}

Report run_dataflow(const core::Database& database, const core::RenderSettings& settings, const RunOptions& options,
                    std::stop_token stop) {
  return run_prepared(prepare(database, settings, options, stop), settings, options, std::move(stop));
}

}  // namespace dmpc::dataflow
