// A picture on several ranks, by any strategy: what rank 0, which alone has the scene, sends the others before they can make
// their nodes, and what they do with it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/expect.h"
#include "core/picture/pixel_task.h"
#include "nodes/computer_request.h"
#include "nodes/flat_bytes.h"
#include "nodes/pictures/computer.h"
#include "nodes/ranks/rank_memory.h"
#include "nodes/ranks/repeated_runs.h"
#include "nodes/runner.h"

namespace dmpc::pictures {

/// A computer request as bytes, without the ranks. Requires that no machine is modelled.
inline void put_computer(nodes::FlatWriter& flat, const nodes::ComputerRequest& computer) {
  core::expect(!computer.machine, "a model has no ranks");
  flat.put(computer.node_count, computer.node_memory_bytes, computer.stack_reserve_bytes, computer.chaos, computer.pool_threads);
}

inline nodes::ComputerRequest take_computer(nodes::FlatReader& flat, nodes::RankLinks& ranks) {
  nodes::ComputerRequest computer;
  flat.take_into(computer.node_count, computer.node_memory_bytes, computer.stack_reserve_bytes, computer.chaos,
                 computer.pool_threads);
  computer.ranks = &ranks;
  return computer;
}

/// The request for a picture that all strategies' plans share, as bytes.
template <class PlanRequest>
void put_picture(nodes::FlatWriter& flat, const PlanRequest& request) {
  put_computer(flat, request.computer);
  flat.put(request.waiting_hits_max, request.width, request.height, request.first_samples, request.refinement, request.bundles,
           request.has_instances);
}
template <class PlanRequest>
void take_picture(nodes::FlatReader& flat, nodes::RankLinks& ranks, PlanRequest& request) {
  request.computer = take_computer(flat, ranks);
  flat.take_into(request.waiting_hits_max, request.width, request.height, request.first_samples, request.refinement,
                 request.bundles, request.has_instances);
}

/// For comparing two plans: any use of a node's memory and mailbox changes their sizes; `own` is the strategy's.
template <class Plan, class... Own>
std::string figures_of(const Plan& plan, const Own&... own) {
  nodes::FlatWriter flat;
  flat.put(plan.node_memory_max_bytes(), plan.node_mailbox.bytes(), plan.host_mailbox.bytes(), own...);
  return flat.take();
}

/// On rank 0, before its own nodes are made: sends each other rank its job, what is to be observed there and, node by node, its
/// program's data. Returns when all have their nodes. put_own(flat) adds the strategy's part to the job, assign(streams, rank,
/// node) sends the node's assignment. `are_frames`: nodes are kept, for nodes::hand_out_again() of settings before another
/// picture. Throws what fails on another rank.
template <class PutOwn, class Assign>
void hand_out(const core::RenderSettings& settings, std::uint32_t node_count, const std::string& observer_order, bool are_frames,
              nodes::RankLinks& links, const PutOwn& put_own, const Assign& assign) {
  nodes::FlatWriter job;
  job.put(nodes::StreamKind::job, are_frames, settings);
  put_own(job);
  nodes::StreamsToRanks streams(links);
  streams.write_counted_to_all(job.take());
  streams.write_counted_to_all(observer_order);
  for (std::uint32_t node = 0; node < node_count; ++node) {
    if (const std::uint32_t rank = nodes::rank_of(node, node_count, links.rank_count()); rank != 0) {
      assign(streams, rank, node);
    }
  }
  streams.finish();
}

/// The nodes of a run that are on this rank. `Job` is how a strategy makes them: it is made from the flat bytes after the
/// settings, all of which it reads, and has a plan(), the specifications() of its nodes, for which it reads their assignments
/// from the stream (and which observe if requested), and gather() of their reports.
template <class Job, class WorkerCallbacks>
class PartOfRun {
 public:
  /// `reported`: read from the stream, of which it reads the rest.
  PartOfRun(std::string_view reported, nodes::StreamFromHost& stream, nodes::RankLinks& links, const WorkerCallbacks& callbacks)
      : PartOfRun(nodes::FlatReader(reported), stream, links, callbacks) {}
  PartOfRun(const PartOfRun&) = delete;
  PartOfRun& operator=(const PartOfRun&) = delete;

  bool is_repeated() const { return are_frames_; }

  void begin_again(std::string_view reported) {
    settings_ = nodes::read_again<core::RenderSettings>(reported);
    begin_frame(*runner_, job_.plan().node_count(), settings_);
    if (!order_.empty()) {
      callbacks_.watch_again();
    }
  }

  nodes::RunEnd run(std::stop_token stop) {
    stream_.say_ready();
    const nodes::RunEnd end = runner_->run(std::move(stop));
    job_.gather(*runner_);
    runner_->gather_ranks(order_.empty() ? std::string() : callbacks_.seen());
    return end;
  }

 private:
  PartOfRun(nodes::FlatReader job, nodes::StreamFromHost& stream, nodes::RankLinks& links, const WorkerCallbacks& callbacks)
      : callbacks_(callbacks), stream_(stream), settings_(beginning_of(job)), job_(job, links, callbacks) {
    core::expect(job.is_at_end(), "a job is as long as it says");
    callbacks.check_room(nodes::rank_memory(nodes::peers_of(job_.plan()), &links, links.rank()));
    order_ = nodes::read_counted(stream);
    watching_ = order_.empty() ? nodes::Watching() : callbacks.watch(order_);
    runner_ = nodes::make_runner(job_.specifications(settings_, stream, watching_, order_.empty() ? nullptr : &callbacks),
                                 job_.plan().request.computer, watching_.observer);
  }

  /// Reads what every job begins with.
  core::RenderSettings beginning_of(nodes::FlatReader& flat) {
    core::expect(flat.take<nodes::StreamKind>() == nodes::StreamKind::job, "nodes are there before frames");
    are_frames_ = flat.take<bool>();
    return flat.take<core::RenderSettings>();
  }

  const WorkerCallbacks& callbacks_;
  nodes::StreamFromHost& stream_;
  bool are_frames_ = false;
  core::RenderSettings settings_;
  Job job_;
  std::string order_;
  nodes::Watching watching_;
  std::unique_ptr<nodes::Runner> runner_;
};

/// Runs a worker rank while rank 0 renders. Of the scene only its nodes' assignments are in its memory. With several frames it
/// goes on with the next, or with new nodes, until rank 0 ends: throws nodes::Dismissed then.
template <class Job, class WorkerCallbacks>
nodes::WorkerOutcome follow(nodes::RankLinks& links, const std::stop_token& stop, const WorkerCallbacks& callbacks) {
  return nodes::run_as_worker(links, stop, [&](std::string_view reported, nodes::StreamFromHost& stream) {
    return PartOfRun<Job, WorkerCallbacks>(reported, stream, links, callbacks);
  });
}

}  // namespace dmpc::pictures
