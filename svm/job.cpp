#include "svm/job.h"

#include <algorithm>
#include <memory>

#include "core/base/expect.h"
#include "nodes/flat_bytes.h"
#include "nodes/flat_computer.h"
#include "nodes/ranks/stream_kind.h"

namespace dmpc::svm {
namespace {

/// By which two plans are told apart: whatever a node's memory and mailbox are for changes their sizes.
struct PlanFigures {
  std::size_t node_memory_max_bytes;
  std::size_t node_mailbox_bytes, host_mailbox_bytes;
  std::uint32_t frames, resident_count, in_flight, pixels_a_task, worker_count, work_item_side, request_credits, film_credits;

  bool operator==(const PlanFigures&) const = default;
};

PlanFigures figures_of(const Plan& plan) {
  return {plan.node_memory_max_bytes(),
          plan.node_mailbox.bytes(),
          plan.host_mailbox.bytes(),
          plan.frames,
          plan.resident_count,
          plan.in_flight,
          plan.pixels_a_task,
          plan.worker_count,
          plan.work_item_side,
          plan.request_credits,
          plan.film_credits};
}

void put(nodes::FlatWriter& flat, const PlanRequest& request) {
  flat.put_bytes(request.strategy->name());
  flat.put(request.page_count);
  flat.put(request.forest_page_count);
  flat.put(request.open_page_count);
  flat.put(request.page_size_bytes);
  put(flat, request.computer);
  PageOptions pages = request.pages;
  pages.reference_logs = nullptr;  // of this process
  flat.put(pages);
  flat.put(request.waiting_hits_max);
  flat.put(request.width);
  flat.put(request.height);
  flat.put(request.first_samples);
  flat.put(request.refinement);
  flat.put(request.bundles);
  flat.put(request.has_instances);
}

const Strategy* strategy_called(std::string_view name, const Strategies& strategies) {
  const auto found = std::find_if(strategies.begin(), strategies.end(), [&](const Strategy* one) { return one->name() == name; });
  core::expect(found != strategies.end(), "all ranks know the strategy of rank 0");
  return *found;
}

PlanRequest take_request(nodes::FlatReader& flat, nodes::RankLinks& ranks, const Strategies& strategies) {
  PlanRequest request;
  request.strategy = strategy_called(flat.take_bytes(), strategies);
  request.page_count = flat.take<std::uint32_t>();
  request.forest_page_count = flat.take<std::uint32_t>();
  request.open_page_count = flat.take<std::uint32_t>();
  request.page_size_bytes = flat.take<std::size_t>();
  request.computer = nodes::take_computer(flat, ranks);
  request.pages = flat.take<PageOptions>();
  request.waiting_hits_max = flat.take<int>();
  request.width = flat.take<std::uint32_t>();
  request.height = flat.take<std::uint32_t>();
  request.first_samples = flat.take<std::uint32_t>();
  request.refinement = flat.take<core::RefinementOptions>();
  request.bundles = flat.take<bool>();
  request.has_instances = flat.take<bool>();
  return request;
}

void put(nodes::FlatWriter& flat, const core::PartialPicture* start) {
  flat.put(start != nullptr);
  if (start != nullptr) {
    flat.put(start->passes);
    flat.put_all(start->pass.steps());
    flat.put_all(start->done.words());
  }
}

std::optional<core::PartialPicture> take_start(nodes::FlatReader& flat, const PlanRequest& request) {
  if (!flat.take<bool>()) {
    return std::nullopt;
  }
  const std::uint32_t pixel_count = request.width * request.height;
  core::PartialPicture start{.film = core::Film(1, 1),  // the light is the host's
                             .passes = flat.take<std::uint32_t>(),
                             .pass = core::Pass(pixel_count, request.first_samples),
                             .done = core::PixelMask(pixel_count)};
  flat.take_all(start.pass.steps());
  flat.take_all(start.done.words());
  return start;
}

}  // namespace

std::string job_bytes(const Plan& plan, const core::RenderSettings& settings, bool are_frames) {
  nodes::FlatWriter flat;
  flat.put(nodes::StreamKind::job);
  flat.put(are_frames);
  put(flat, plan.request);
  flat.put(settings);
  put(flat, plan.request.start);
  flat.put_all(plan.resident);
  flat.put(figures_of(plan));
  return flat.take();
}

std::unique_ptr<Job> job_from(std::string_view bytes, nodes::RankLinks& ranks, const Strategies& strategies) {
  nodes::FlatReader flat(bytes);
  core::expect(flat.take<nodes::StreamKind>() == nodes::StreamKind::job, "nodes are there before frames");
  const auto are_frames = flat.take<bool>();
  PlanRequest request = take_request(flat, ranks, strategies);
  const auto settings = flat.take<core::RenderSettings>();
  auto job = std::make_unique<Job>(Plan{}, settings);
  job->are_frames = are_frames;
  job->start = take_start(flat, request);
  request.start = job->start ? &*job->start : nullptr;
  job->plan = make_plan(request);
  job->plan.resident = flat.take_all<PageId>();
  core::expect(flat.take<PlanFigures>() == figures_of(job->plan) && flat.is_at_end(), "all ranks have one plan");
  return job;
}

}  // namespace dmpc::svm
