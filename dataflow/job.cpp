#include "dataflow/job.h"

#include <utility>

#include "core/base/expect.h"
#include "nodes/flat_bytes.h"
#include "nodes/flat_computer.h"
#include "nodes/ranks/stream_kind.h"

namespace dmpc::dataflow {
namespace {

/// By which two plans are told apart: whatever a node's memory and mailbox are for changes their sizes.
struct PlanFigures {
  std::size_t node_memory_max_bytes;
  std::size_t node_mailbox_bytes, host_mailbox_bytes;
  std::uint32_t ray_batch, ray_credits, ray_places, host_credits, queue_packets, rays_a_task, film_credits, spare_frames;

  bool operator==(const PlanFigures&) const = default;
};

PlanFigures figures_of(const Plan& plan) {
  return {plan.node_memory_max_bytes(),
          plan.node_mailbox.bytes(),
          plan.host_mailbox.bytes(),
          plan.ray_batch,
          plan.ray_credits,
          plan.ray_places,
          plan.host_credits,
          plan.queue_packets,
          plan.rays_a_task,
          plan.film_credits,
          plan.spare_frames};
}

void put(nodes::FlatWriter& flat, const PlanRequest& request) {
  flat.put_all(request.shares);
  put(flat, request.computer);
  flat.put(request.rays);
  flat.put(request.depth_max);
  flat.put(request.waiting_hits_max);
  flat.put(request.width);
  flat.put(request.height);
  flat.put(request.first_samples);
  flat.put(request.refinement);
  flat.put(request.is_dealt_on_the_way);
  flat.put(request.bundles);
  flat.put(request.has_instances);
}

PlanRequest take_request(nodes::FlatReader& flat, nodes::RankLinks& ranks) {
  PlanRequest request;
  request.shares = flat.take_all<Share>();
  request.computer = nodes::take_computer(flat, ranks);
  request.rays = flat.take<RayOptions>();
  request.depth_max = flat.take<std::uint32_t>();
  request.waiting_hits_max = flat.take<std::uint32_t>();
  request.width = flat.take<std::uint32_t>();
  request.height = flat.take<std::uint32_t>();
  request.first_samples = flat.take<std::uint32_t>();
  request.refinement = flat.take<core::RefinementOptions>();
  request.is_dealt_on_the_way = flat.take<bool>();
  request.bundles = flat.take<bool>();
  request.has_instances = flat.take<bool>();
  return request;
}

}  // namespace

std::string job_bytes(const Plan& plan, const core::RenderSettings& settings, const Regions& regions,
                      const core::DatabasePart& outline, bool are_frames) {
  nodes::FlatWriter flat;
  flat.put(nodes::StreamKind::job);
  flat.put(are_frames);
  put(flat, plan.request);
  flat.put(settings);
  flat.put(regions);
  flat.put(outline.header);
  flat.put_all(outline.bytes);
  flat.put(figures_of(plan));
  return flat.take();
}

Job job_from(std::string_view bytes, nodes::RankLinks& ranks) {
  nodes::FlatReader flat(bytes);
  core::expect(flat.take<nodes::StreamKind>() == nodes::StreamKind::job, "nodes are there before frames");
  const auto are_frames = flat.take<bool>();
  Plan plan = make_plan(take_request(flat, ranks));
  const auto settings = flat.take<core::RenderSettings>();
  Job job{
      .plan = std::move(plan), .settings = settings, .regions = flat.take<Regions>(), .outline = {}, .are_frames = are_frames};
  job.outline.header = flat.take<core::DatabaseHeader>();
  job.outline.bytes = flat.take_all<std::byte>();
  core::expect(flat.take<PlanFigures>() == figures_of(job.plan) && flat.is_at_end(), "all ranks have one plan");
  return job;
}

}  // namespace dmpc::dataflow
