#include "dataflow/ranks.h"

#include <string_view>
#include <utility>
#include <vector>

#include "core/base/expect.h"
#include "dataflow/program.h"
#include "dataflow/run.h"
#include "nodes/byte_source.h"
#include "nodes/pictures/ranks.h"

namespace dmpc::dataflow {
namespace {

std::string figures_of(const Plan& plan) {
  return pictures::figures_of(plan, plan.ray_batch, plan.ray_credits, plan.ray_slots, plan.host_credits, plan.queue_packets,
                              plan.rays_a_task, plan.film_credits, plan.spare_frames);
}

PlanRequest take_request(nodes::FlatReader& flat, nodes::RankLinks& ranks) {
  PlanRequest request;
  request.shares = flat.take_all<Share>();
  flat.take_into(request.rays, request.depth_max, request.is_assigned_on_the_way);
  pictures::take_picture(flat, ranks, request);
  return request;
}

/// The assignment of a node, except for its records, which follow it and which its program reads itself.
struct Assigned {
  core::DatabaseHeader header;
  std::size_t record_bytes = 0;
  std::vector<PrimaryRun> primaries;
  std::vector<std::uint32_t> pages, runs_of_unit;  ///< if regions move
};

std::string assigned_bytes(const Distribution& distribution, std::uint32_t node) {
  const core::DatabasePart& part = distribution.parts[node];
  nodes::FlatWriter flat;
  flat.put(part.header, std::size_t{part.bytes.size()});
  flat.put_all(distribution.primaries[node]);
  flat.put_all(distribution.pages[node]);
  flat.put_all(distribution.runs_of_unit[node]);
  return flat.take();
}

Assigned assigned_from(std::string_view bytes) {
  nodes::FlatReader flat(bytes);
  const auto header = flat.take<core::DatabaseHeader>();
  const auto record_bytes = flat.take<std::size_t>();
  auto primaries = flat.take_all<PrimaryRun>();
  auto pages = flat.take_all<std::uint32_t>();
  return {header, record_bytes, std::move(primaries), std::move(pages), flat.take_all<std::uint32_t>()};
}

/// The data from which a rank without the host creates its nodes.
class Job {
 public:
  /// Recomputes the plan and expects it to be equal.
  Job(nodes::FlatReader& flat, nodes::RankLinks& ranks, const nodes::WorkerCallbacks& /*following*/)
      : plan_(make_plan(take_request(flat, ranks))), regions_(flat.take<Regions>()) {
    proxy_.header = flat.take<core::DatabaseHeader>();
    proxy_.bytes = flat.take_all<std::byte>();
    core::expect(flat.take_bytes() == figures_of(plan_), "all ranks have one plan");
  }

  const Plan& plan() const { return plan_; }
  std::vector<nodes::NodeSpecification> specifications(const core::RenderSettings& settings, nodes::StreamFromHost& stream,
                                                       const nodes::Watching& watching,
                                                       const nodes::WorkerCallbacks* /*watched*/) {
    return specifications_without_host(plan_, [&](std::uint32_t, nodes::Node& node) {
      const Assigned assigned = assigned_from(nodes::read_counted(stream));
      return make_node_program(
          node, plan_,
          NodeAssignment{assigned.header, nodes::ByteSource(stream, assigned.record_bytes), assigned.primaries, settings,
                         regions_, proxy_, assigned.pages, assigned.runs_of_unit},
          nodes::meter_for(watching, plan_.request.computer, node.id()));
    });
  }
  void gather(nodes::Runner& runner) const { gather_reports(runner, plan_); }

 private:
  Plan plan_;
  Regions regions_;
  core::DatabasePart proxy_;  ///< only its header and bytes
};

}  // namespace

void hand_out(const Plan& plan, const Distribution& distribution, const core::RenderSettings& settings,
              const std::string& observer_order, bool are_frames, nodes::RankLinks& links) {
  const auto put_own = [&](nodes::FlatWriter& job) {
    job.put_all(plan.request.shares);
    job.put(plan.request.rays, plan.request.depth_max, plan.request.is_assigned_on_the_way);
    pictures::put_picture(job, plan.request);
    job.put(distribution.regions, distribution.proxy.header);
    job.put_all(distribution.proxy.bytes);
    job.put_bytes(figures_of(plan));
  };
  const auto assign = [&](nodes::StreamsToRanks& streams, std::uint32_t rank, std::uint32_t node) {
    const core::DatabasePart& part = distribution.parts[node];
    const std::string assigned = assigned_bytes(distribution, node);
    streams.write_counted(rank, std::as_bytes(std::span(assigned)));
    streams.write_piece(rank, part.bytes, 0, part.bytes.size());
  };
  pictures::hand_out(settings, plan.node_count(), observer_order, are_frames, links, put_own, assign);
}

nodes::WorkerOutcome follow(nodes::RankLinks& links, std::stop_token stop, const nodes::WorkerCallbacks& callbacks) {
  return pictures::follow<Job>(links, stop, callbacks);
}

}  // namespace dmpc::dataflow
