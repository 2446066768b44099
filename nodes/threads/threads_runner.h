// Runs the node programs on one thread per node, or on a few that run all in turn, wall clock; idle threads sleep.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "nodes/chaos.h"
#include "nodes/runner.h"
#include "nodes/threads/node_threads.h"

namespace dmpc::nodes {

/// As Runner; on one thread per node or on a pool of threads, wall clock.
class ThreadsRunner final : public Runner {
 public:
  /// `specifications`: the nodes in order, then the host. With `chaos` the computer delays and reorders packets, and some of its
  /// nodes are slow; the strategy shrinks the credits (shrunk_credits()). `observer`, if given, is called on the nodes' threads.
  /// `pool_threads` and `immutable`: as in ComputerRequest.
  explicit ThreadsRunner(std::span<const NodeSpecification> specifications, const std::optional<Chaos>& chaos = std::nullopt,
                         Observer* observer = nullptr, const std::optional<std::uint32_t>& pool_threads = std::nullopt,
                         Immutable immutable = Immutable::is_copied);

  /// Starts the threads. After a stop is requested every thread ends within a quantum. A deadlock is detected exactly, without a
  /// timeout: all nodes sleep and nothing is in flight.
  RunEnd run(std::stop_token stop) override;
  Node& node(std::size_t index) override;
  Program& program(std::size_t index) override;
  std::vector<std::string> gather(const Report& report) override;

 private:
  RunEnd judge() const;

  NodeThreads nodes_;
  std::optional<Chaos> disturbance_;
  bool is_started_ = false;
};

}  // namespace dmpc::nodes
