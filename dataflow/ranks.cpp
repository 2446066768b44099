#include "dataflow/ranks.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "dataflow/job.h"
#include "dataflow/program.h"
#include "dataflow/run.h"
#include "nodes/byte_source.h"
#include "nodes/flat_bytes.h"
#include "nodes/ranks/ranks_runner.h"
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
              const std::string& watch_order, nodes::RankLinks& links) {
  nodes::StreamsToRanks streams(links);
  const std::string job = job_bytes(plan, settings, distribution.regions, distribution.outline);
  for (std::uint32_t rank = 1; rank < links.rank_count(); ++rank) {
    streams.write_counted(rank, std::as_bytes(std::span(job)));
    streams.write_counted(rank, std::as_bytes(std::span(watch_order)));
  }
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

nodes::Followed follow(nodes::RankLinks& links, std::stop_token stop, const nodes::Following& following) {
  nodes::StreamFromHost stream(links);
  const Job job = job_from(nodes::read_counted(stream), links);
  following.check_room(nodes::rank_memory(nodes::peers_of(job.plan), &links, links.rank()));
  const std::string order = nodes::read_counted(stream);
  const nodes::Watching watching = order.empty() ? nodes::Watching() : following.watch(order);
  const MakeProgram make_program = [&](std::uint32_t, nodes::Node& node) {
    const Dealt dealt = dealt_from(nodes::read_counted(stream));
    return make_node_program(node, job.plan,
                             NodeDeal{dealt.header, nodes::ByteSource(stream, dealt.record_bytes), dealt.primaries, job.settings,
                                      job.regions, job.outline, dealt.pages, dealt.runs_of_unit},
                             nodes::meter_for(watching, job.plan.request.computer, node.id()));
  };
  const auto runner =
      nodes::make_runner(specifications_without_host(job.plan, make_program), job.plan.request.computer, watching.observer);
  stream.say_ready();
  nodes::Followed followed{.bytes_received = stream.bytes_read()};
  followed.end = runner->run(std::move(stop));
  gather_reports(*runner, job.plan);
  runner->gather_ranks(order.empty() ? std::string() : following.seen());
  return followed;
}

}  // namespace dmpc::dataflow
