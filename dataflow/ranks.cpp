#include "dataflow/ranks.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dataflow/job.h"
#include "dataflow/program.h"
#include "dataflow/run.h"
#include "nodes/byte_source.h"
#include "nodes/flat_bytes.h"
#include "nodes/ranks/ranks_runner.h"
#include "nodes/ranks/repeated_runs.h"
#include "nodes/ranks/stream_from_host.h"
#include "nodes/ranks/streams_to_ranks.h"

namespace dmpc::dataflow {
namespace {

/// What a node is dealt but for its records, which its program reads itself, behind it.
struct Dealt {
  core::DatabaseHeader header;
  std::size_t record_bytes = 0;
  std::vector<PrimaryRun> primaries;
  std::vector<std::uint32_t> pages, runs_of_unit;  ///< where regions move
};

std::string dealt_bytes(const Distribution& distribution, std::uint32_t node) {
  const core::DatabasePart& part = distribution.parts[node];
  nodes::FlatWriter flat;
  flat.put(part.header);
  flat.put(std::size_t{part.bytes.size()});
  flat.put_all(distribution.primaries[node]);
  flat.put_all(distribution.pages[node]);
  flat.put_all(distribution.runs_of_unit[node]);
  return flat.take();
}

Dealt dealt_from(std::string_view bytes) {
  nodes::FlatReader flat(bytes);
  const auto header = flat.take<core::DatabaseHeader>();
  const auto record_bytes = flat.take<std::size_t>();
  auto primaries = flat.take_all<PrimaryRun>();
  auto pages = flat.take_all<std::uint32_t>();
  return {header, record_bytes, std::move(primaries), std::move(pages), flat.take_all<std::uint32_t>()};
}

}  // namespace

void hand_out(const Plan& plan, const Distribution& distribution, const core::RenderSettings& settings,
              const std::string& watch_order, bool are_frames, nodes::RankLinks& links) {
  nodes::StreamsToRanks streams(links);
  const std::string job = job_bytes(plan, settings, distribution.regions, distribution.outline, are_frames);
  streams.write_counted_to_all(job);
  streams.write_counted_to_all(watch_order);
  for (std::uint32_t node = 0; node < plan.node_count(); ++node) {
    const std::uint32_t rank = nodes::rank_of(node, plan.node_count(), links.rank_count());
    if (rank != 0) {
      const core::DatabasePart& part = distribution.parts[node];
      const std::string dealt = dealt_bytes(distribution, node);
      streams.write_counted(rank, std::as_bytes(std::span(dealt)));
      streams.write_piece(rank, part.bytes, 0, part.bytes.size());
    }
  }
  streams.finish();
}

namespace {

/// The nodes of a run that are here, and what they are made of.
class Part {
 public:
  /// `job`: read from the stream, of which it reads the rest.
  Part(std::string_view job, nodes::StreamFromHost& stream, nodes::RankLinks& links, const nodes::Following& following)
      : following_(following), stream_(stream), job_(job_from(job, links)) {
    following.check_room(nodes::rank_memory(nodes::peers_of(job_.plan), &links, links.rank()));
    order_ = nodes::read_counted(stream);
    watching_ = order_.empty() ? nodes::Watching() : following.watch(order_);
    const MakeProgram make_program = [this](std::uint32_t, nodes::Node& node) { return program_for(node); };
    runner_ =
        nodes::make_runner(specifications_without_host(job_.plan, make_program), job_.plan.request.computer, watching_.observer);
  }
  Part(const Part&) = delete;
  Part& operator=(const Part&) = delete;

  bool is_repeated() const { return job_.are_frames; }

  void begin_again(std::string_view told) {
    job_.settings = nodes::read_again<core::RenderSettings>(told);
    for (std::uint32_t node = 0; node < job_.plan.node_count(); ++node) {
      if (runner_->is_here(node)) {
        dynamic_cast<NodeProgram&>(runner_->program(node)).begin_frame(job_.settings);
      }
    }
    if (!order_.empty()) {
      following_.watch_again();
    }
  }

  nodes::RunEnd run(std::stop_token stop) {
    stream_.say_ready();
    const nodes::RunEnd end = runner_->run(std::move(stop));
    gather_reports(*runner_, job_.plan);
    runner_->gather_ranks(order_.empty() ? std::string() : following_.seen());
    return end;
  }

 private:
  std::unique_ptr<NodeProgram> program_for(nodes::Node& node) {
    const Dealt dealt = dealt_from(nodes::read_counted(stream_));
    return make_node_program(node, job_.plan,
                             NodeDeal{dealt.header, nodes::ByteSource(stream_, dealt.record_bytes), dealt.primaries,
                                      job_.settings, job_.regions, job_.outline, dealt.pages, dealt.runs_of_unit},
                             nodes::meter_for(watching_, job_.plan.request.computer, node.id()));
  }

  const nodes::Following& following_;
  nodes::StreamFromHost& stream_;
  Job job_;
  std::string order_;
  nodes::Watching watching_;
  std::unique_ptr<nodes::Runner> runner_;
};

}  // namespace

nodes::Followed follow(nodes::RankLinks& links, std::stop_token stop, const nodes::Following& following) {
  return nodes::follow_runs(
      links, stop, [&](std::string_view job, nodes::StreamFromHost& stream) { return Part(job, stream, links, following); });
}

}  // namespace dmpc::dataflow
