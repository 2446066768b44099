#include "svm/ranks.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "nodes/byte_source.h"
#include "nodes/ranks/ranks_runner.h"
#include "nodes/ranks/repeated_runs.h"
#include "nodes/ranks/stream_from_host.h"
#include "nodes/ranks/streams_to_ranks.h"
#include "svm/job.h"
#include "svm/program.h"
#include "svm/run.h"

namespace dmpc::svm {

void hand_out(const Plan& plan, const core::RenderSettings& settings, const core::Database& database,
              const std::string& watch_order, bool are_frames, nodes::RankLinks& links) {
  nodes::StreamsToRanks streams(links);
  const std::uint32_t node_count = plan.request.computer.node_count;
  const std::string job = job_bytes(plan, settings, are_frames);
  streams.write_counted_to_all(job);
  streams.write_counted_to_all(watch_order);
  for (std::uint32_t node = 0; node < node_count; ++node) {
    const std::uint32_t rank = nodes::rank_of(node, node_count, links.rank_count());
    plan.request.strategy->for_each_piece(plan, node, [&](std::size_t offset, std::size_t bytes) {
      if (rank != 0) {
        streams.write_piece(rank, database.bytes(), offset, bytes);
      }
    });
  }
  streams.finish();
}

namespace {

/// The nodes of a run that are here, and what they are made of.
class Part {
 public:
  /// `job`: read from the stream, of which it reads the rest.
  Part(std::string_view job, nodes::StreamFromHost& stream, nodes::RankLinks& links, const Following& following)
      : following_(following), stream_(stream), job_(job_from(job, links, following.strategies)) {
    following.check_room(nodes::rank_memory(nodes::peers_of(job_->plan), &links, links.rank()));
    order_ = nodes::read_counted(stream);
    const nodes::Watching watching = order_.empty() ? nodes::Watching() : following.watch(order_);
    pages_.emplace(stream, job_->plan.pages().database_bytes());
    maker_ = job_->plan.request.strategy->maker(job_->plan, job_->settings, *pages_, watching,
                                                order_.empty() ? nullptr : following.reference_logs());
    runner_ = nodes::make_runner(specifications_without_host(job_->plan, maker_), job_->plan.request.computer, watching.observer);
  }

  bool is_repeated() const { return job_->are_frames; }

  void begin_again(std::string_view told) {
    job_->settings = nodes::read_again<core::RenderSettings>(told);
    for (std::uint32_t node = 0; node < job_->plan.request.computer.node_count; ++node) {
      if (runner_->is_here(node)) {
        dynamic_cast<PictureProgram&>(runner_->program(node)).begin_frame(job_->settings);
      }
    }
    if (!order_.empty()) {
      following_.watch_again();
    }
  }

  nodes::RunEnd run(std::stop_token stop) {
    stream_.say_ready();
    const nodes::RunEnd end = runner_->run(std::move(stop));
    gather_reports(*runner_, job_->plan);
    runner_->gather_ranks(order_.empty() ? std::string() : following_.seen());
    return end;
  }

 private:
  const Following& following_;
  nodes::StreamFromHost& stream_;
  std::unique_ptr<Job> job_;
  std::string order_;
  std::optional<nodes::ByteSource> pages_;
  MakeProgram maker_;
  std::unique_ptr<nodes::Runner> runner_;
};

}  // namespace

nodes::Followed follow(nodes::RankLinks& links, std::stop_token stop, const Following& following) {
  return nodes::follow_runs(
      links, stop, [&](std::string_view job, nodes::StreamFromHost& stream) { return Part(job, stream, links, following); });
}

}  // namespace dmpc::svm
