#include "dataflow/frames.h"

#include <algorithm>
#include <utility>

#include "core/base/expect.h"
#include "dataflow/packets.h"
#include "dataflow/ranks.h"
#include "nodes/gathering.h"

namespace dmpc::dataflow {
namespace {

using nodes::TrafficByKind;

/// Reports the positions of a node's regions.
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

/// Whether all credits of a node, or of the host, have come back.
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

/// Adds what was assigned to the node.
void report_share(NodeReport& report, const Distribution& distribution, std::uint32_t index, const Share& share) {
  report.part_bytes = share.part_bytes;
  report.primitive_copies = distribution.parts[index].primitive_copies;
  for (const PrimaryRun& run : distribution.primaries[index]) {
    report.primary_rays += run.count;
  }
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

/// Every migrated unit was received, and each unit has one owner.
void check_units(const Report& report) {
  const MovementCounters sum = report.movement();
  core::expect(sum.units_given == sum.units_taken, "every unit that was migrated was taken");
  core::expect(sum.primaries_given == sum.primaries_taken, "every primary ray that was migrated was taken");
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

/// The owners that have received something since then.
std::vector<SentToOwner> since(const std::vector<SentToOwner>& now, const std::vector<SentToOwner>& before) {
  std::vector<SentToOwner> changed;
  auto earlier = before.begin();
  for (const SentToOwner& sent : now) {
    const bool is_known = earlier != before.end() && earlier->owner == sent.owner;
    const PairCounters count = core::counts_since<PairCounters>(sent, is_known ? *earlier++ : SentToOwner{});
    if (count.packets != 0 || count.rays_total() != 0) {
      changed.push_back({count, sent.owner});
    }
  }
  return changed;
}

/// Counts, but not maxima and latest values, become those of the frame.
ProgramReport since(const ProgramReport& now, const ProgramReport& before) {
  ProgramReport report = now;
  report.operations = core::counts_since(now.operations, before.operations);
  report.rays = core::counts_since(now.rays, before.rays);
  report.gather = core::counts_since(now.gather, before.gather);
  report.gather.queue_high_water = now.gather.queue_high_water;
  report.film = core::counts_since(now.film, before.film);
  report.movement = core::counts_since(now.movement, before.movement);
  report.movement.units = now.movement.units;
  report.pairs = since(now.pairs, before.pairs);
  return report;
}

HostCounters since(const HostCounters& now, const HostCounters& before) {
  HostCounters counters = core::counts_since(now, before);
  counters.rays_buffered_max = now.rays_buffered_max;
  counters.buffered_bytes_max = now.buffered_bytes_max;
  counters.deposits_saturated = now.deposits_saturated;
  return counters;
}

}  // namespace

Frames::Frames(const Prepared& prepared, const core::RenderSettings& first, const RunOptions& options,
               const std::stop_token& stop)
    : prepared_(prepared), options_(options), settings_(first), detail_(prepared.detail), plan_(prepared.plan) {
  before_.nodes.resize(plan_.node_count());
  if (options_.computer.ranks != nullptr) {
    hand_out(plan_, prepared_.distribution, settings_, options_.watching.elsewhere.order, options_.are_frames,
             *options_.computer.ranks);
  }
  computer_.emplace(
      pictures::film_of(plan_.request, first.shade.film_scale, options.continuation.start),
      [&](core::Film& film) {
        return specifications_of(plan_, prepared_.distribution, settings_, film, options_, stop, &detail_);
      },
      options_.computer, options_.watching);
  if (options_.watching.distributed) {
    options_.watching.distributed();
  }
}

Report Frames::render(const core::RenderSettings& settings, const core::FineDetail& detail, std::stop_token stop) {
  core::expect(options_.are_frames, "several frames are said to be several");
  options_.continuation.start = nullptr;  // for the first frame only
  settings_ = settings;
  detail_ = detail;
  computer_->begin_frame(pictures::film_of(plan_.request, settings.shade.film_scale), settings_, &detail_);
  return render(std::move(stop));
}

Report Frames::render(std::stop_token stop) {
  const core::PartialPicture* const start = options_.continuation.start;
  GatheredReports gathered;
  pictures::Outcome outcome =
      computer_->render(std::move(stop), plan_, [&] { gathered = gather_reports(computer_->runner(), plan_); });
  Report report{{std::move(outcome), std::move(gathered.nodes)},
                start != nullptr ? start->samples_done() : 0,
                plan_,
                prepared_.distribution.regions,
                prepared_.predicted,
                prepared_.duplication};
  add_shares(report);
  const HostCounters counted = dynamic_cast<const HostProgram&>(computer_->host()).report();
  report.host_rays = since(counted, before_.host);
  before_.host = counted;
  if (report.end == nodes::RunEnd::finished) {
    check_rays(report);
    check_units(report);
    check_packets(report);
    core::expect(gathered.are_credits_back, "every credit has come back, and every packet of primary rays was worked off");
  }
  return report;
}

/// Adds each node's work for this frame and its assignment.
void Frames::add_shares(Report& report) {
  const Distribution& distribution = prepared_.distribution;
  const std::vector<std::vector<std::uint32_t>> regions = distribution.regions.by_node();
  for (std::uint32_t i = 0; i < plan_.node_count(); ++i) {
    const ProgramReport counted = std::exchange(report.nodes[i].program, since(report.nodes[i].program, before_.nodes[i]));
    before_.nodes[i] = counted;
    report_share(report.nodes[i], distribution, i, plan_.request.shares[i]);
    report_regions(report.nodes[i], distribution.regions, regions[i]);
  }
}

GatheredReports gather_reports(nodes::Runner& runner, const Plan& plan) {
  const std::uint32_t host = plan.node_count();
  GatheredReports gathered{.are_credits_back = !runner.is_here(host) || has_its_credits(runner.node(host), plan)};
  nodes::gather_nodes(
      runner, host,
      [&](std::size_t index, nodes::FlatWriter& reported) {
        const ProgramReport program = dynamic_cast<const NodeProgram&>(runner.program(index)).report();
        reported.put(static_cast<const ProgramCounts&>(program));
        reported.put_all(program.pairs);
        reported.put(nodes::figures_of(runner.node(index)));
        reported.put(has_its_credits(runner.node(index), plan));
      },
      [&](std::size_t, nodes::FlatReader& reported) {
        NodeReport& report = gathered.nodes.emplace_back();
        static_cast<ProgramCounts&>(report.program) = reported.take<ProgramCounts>();
        report.program.pairs = reported.take_all<SentToOwner>();
        static_cast<nodes::NodeFigures&>(report) = reported.take<nodes::NodeFigures>();
        gathered.are_credits_back = reported.take<bool>() && gathered.are_credits_back;
      });
  return gathered;
}

}  // namespace dmpc::dataflow
