#include "svm/ranks.h"

#include <algorithm>
#include <optional>
#include <string_view>

#include "core/base/expect.h"
#include "nodes/byte_source.h"
#include "nodes/pictures/ranks.h"
#include "svm/run.h"

namespace dmpc::svm {
namespace {

std::string figures_of(const Plan& plan) {
  return pictures::figures_of(plan, plan.frames, plan.resident_count, plan.in_flight, plan.pixels_a_task, plan.worker_count,
                              plan.work_item_side, plan.request_credits, plan.film_credits);
}

void put(nodes::FlatWriter& flat, const PlanRequest& request) {
  flat.put_bytes(request.strategy->name());
  PageOptions pages = request.pages;
  pages.reference_logs = nullptr;  // of this process
  pages.own_policy = nullptr;      // none on ranks
  flat.put(request.page_count, request.forest_page_count, request.open_page_count, request.page_size_bytes, pages);
  pictures::put_picture(flat, request);
}

const Strategy* strategy_called(std::string_view name, const Strategies& strategies) {
  const auto found = std::find_if(strategies.begin(), strategies.end(), [&](const Strategy* one) { return one->name() == name; });
  core::expect(found != strategies.end(), "all ranks know the strategy of rank 0");
  return *found;
}

PlanRequest take_request(nodes::FlatReader& flat, nodes::RankLinks& ranks, const Strategies& strategies) {
  PlanRequest request;
  request.strategy = strategy_called(flat.take_bytes(), strategies);
  flat.take_into(request.page_count, request.forest_page_count, request.open_page_count, request.page_size_bytes, request.pages);
  pictures::take_picture(flat, ranks, request);
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
  core::PartialPicture start{.film = core::Film(1, 1),  // the host has the light
                             .passes = flat.take<std::uint32_t>(),
                             .pass = core::Pass(pixel_count, request.first_samples),
                             .done = core::PixelMask(pixel_count)};
  flat.take_all(start.pass.steps());
  flat.take_all(start.done.words());
  return start;
}

/// The data from which a rank without the host creates its nodes.
class Job {
 public:
  /// Recomputes the plan and expects it to be equal.
  Job(nodes::FlatReader& flat, nodes::RankLinks& ranks, const WorkerCallbacks& callbacks) {
    PlanRequest request = take_request(flat, ranks, callbacks.strategies);
    start_ = take_start(flat, request);
    request.start = start_ ? &*start_ : nullptr;
    plan_ = make_plan(request);
    plan_.resident = flat.take_all<PageId>();
    core::expect(flat.take_bytes() == figures_of(plan_), "all ranks have one plan");
  }

  const Plan& plan() const { return plan_; }
  std::vector<nodes::NodeSpecification> specifications(const core::RenderSettings& settings, nodes::StreamFromHost& stream,
                                                       const nodes::Watching& watching, const WorkerCallbacks* watched) {
    pages_.emplace(stream, plan_.pages().database_bytes());
    std::vector<ReferenceLog>* const logs = watched == nullptr ? nullptr : watched->reference_logs();
    return specifications_without_host(plan_, plan_.request.strategy->maker(plan_, settings, *pages_, watching, logs));
  }
  void gather(nodes::Runner& runner) const { gather_reports(runner, plan_); }

 private:
  std::optional<core::PartialPicture> start_;  ///< if the picture has been begun
  Plan plan_;                                  ///< refers to it
  std::optional<nodes::ByteSource> pages_;
};

}  // namespace

void hand_out(const Plan& plan, const core::RenderSettings& settings, const core::Database& database,
              const std::string& observer_order, bool are_frames, nodes::RankLinks& links) {
  const auto put_own = [&](nodes::FlatWriter& job) {
    put(job, plan.request);
    put(job, plan.request.start);
    job.put_all(plan.resident);
    job.put_bytes(figures_of(plan));
  };
  const auto assign = [&](nodes::StreamsToRanks& streams, std::uint32_t rank, std::uint32_t node) {
    plan.request.strategy->for_each_piece(
        plan, node, [&](std::size_t offset, std::size_t bytes) { streams.write_piece(rank, database.bytes(), offset, bytes); });
  };
  pictures::hand_out(settings, plan.node_count(), observer_order, are_frames, links, put_own, assign);
}

nodes::WorkerOutcome follow(nodes::RankLinks& links, std::stop_token stop, const WorkerCallbacks& callbacks) {
  return pictures::follow<Job>(links, stop, callbacks);
}

}  // namespace dmpc::svm
