#include "svm/ranks.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "nodes/byte_source.h"
#include "nodes/ranks/ranks_runner.h"
#include "nodes/ranks/stream_from_host.h"
#include "nodes/ranks/streams_to_ranks.h"
#include "svm/job.h"
#include "svm/run.h"

namespace dmpc::svm {

void hand_out(const Plan& plan, const core::RenderSettings& settings, const core::Database& database,
              const std::string& watch_order, nodes::RankLinks& links) {
  nodes::StreamsToRanks streams(links);
  const std::uint32_t node_count = plan.request.computer.node_count;
  const std::string job = job_bytes(plan, settings);
  for (std::uint32_t rank = 1; rank < links.rank_count(); ++rank) {
    streams.write_counted(rank, std::as_bytes(std::span(job)));
    streams.write_counted(rank, std::as_bytes(std::span(watch_order)));
  }
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

nodes::Followed follow(nodes::RankLinks& links, std::stop_token stop, const Following& following) {
  nodes::StreamFromHost stream(links);
  const std::unique_ptr<Job> job = job_from(nodes::read_counted(stream), links, following.strategies);
  following.check_room(nodes::rank_memory(nodes::peers_of(job->plan), &links, links.rank()));
  const std::string order = nodes::read_counted(stream);
  const nodes::Watching watching = order.empty() ? nodes::Watching() : following.watch(order);
  const nodes::ByteSource pages(stream, job->plan.pages().database_bytes());
  const MakeProgram make_program = job->plan.request.strategy->maker(job->plan, job->settings, pages, watching,
                                                                     order.empty() ? nullptr : following.reference_logs());
  const auto runner =
      nodes::make_runner(specifications_without_host(job->plan, make_program), job->plan.request.computer, watching.observer);
  stream.say_ready();
  nodes::Followed followed{.bytes_received = stream.bytes_read()};
  followed.end = runner->run(std::move(stop));
  gather_reports(*runner, job->plan);
  runner->gather_ranks(order.empty() ? std::string() : following.seen());
  return followed;
}

}  // namespace dmpc::svm
