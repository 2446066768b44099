// Which node starts which primary rays: dealt by the host before the start, kept by each node as runs.
#pragma once

#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "core/camera.h"
#include "core/expect.h"
#include "core/record.h"
#include "dataflow/bsp.h"
#include "nodes/local_memory.h"

namespace dmpc::dataflow {

/// Consecutive primary rays. The ray of a pixel and a sample has the number pixel * samples + sample.
struct PrimaryRun {
  std::uint64_t first = 0;
  std::uint64_t count = 0;
};

/// For each node, the rays that enter the grid in its region, or reach it before any other that holds something, ascending. A ray
/// that meets no such region only leaves the background on the film: these are spread by pixel number, an equal share of the
/// picture a node, so that no node has all of the sky. Nodes whose region holds nothing get no ray at all.
/// After a stop is requested it ends early, with what it has.
std::vector<std::vector<PrimaryRun>> deal_primaries(const core::Camera& camera, const core::GridFrame& frame, const Bsp& bsp,
                                                    const std::stop_token& stop = {});

/// A node's own primary rays, in its local memory. Thread safety: belongs to one node.
class Primaries {
 public:
  /// Copies `runs`.
  Primaries(nodes::LocalMemory& memory, std::span<const PrimaryRun> runs)
      : runs_(memory.allocate<PrimaryRun>(nodes::Category::queues, runs.size())) {
    for (std::size_t i = 0; i < runs.size(); ++i) {
      runs_[i] = runs[i];
      left_ += runs[i].count;
    }
  }
  /// Adds to `plan` exactly what the constructor takes.
  static void add_needs(nodes::MemoryPlan& plan, std::size_t run_count) {
    plan[nodes::Category::queues] += nodes::LocalMemory::bytes_for<PrimaryRun>(run_count);
  }

  bool empty() const { return left_ == 0; }
  /// Rays that have not started.
  std::uint64_t left() const { return left_; }
  /// The number of the next ray to start. Requires that one is left.
  std::uint64_t take() {
    core::expect(left_ > 0, "a primary ray starts once");
    --left_;
    const PrimaryRun& run = runs_[run_];
    const std::uint64_t number = run.first + started_of_run_;
    if (++started_of_run_ == run.count) {
      ++run_;
      started_of_run_ = 0;
    }
    return number;
  }

 private:
  std::span<PrimaryRun> runs_;
  std::size_t run_ = 0;
  std::uint64_t started_of_run_ = 0;
  std::uint64_t left_ = 0;
};

}  // namespace dmpc::dataflow
