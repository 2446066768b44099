// The node that starts each primary ray: assigned by the host before the start and before every later pass, stored by each node
// as runs.
#pragma once

#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "core/picture/pixel_task.h"
#include "core/picture/sampling/sample_pass.h"
#include "dataflow/packets.h"
#include "dataflow/rays/pixel_order.h"
#include "dataflow/regions/regions.h"
#include "nodes/layout.h"
#include "nodes/local_memory.h"

namespace dmpc::dataflow {

/// For each node, the rays of a pass, without those of pixels that are done, that enter the grid in a region of its own, or reach
/// one before any other that is not empty, ascending. A ray that meets no such region, or whose pixel shows the background, only
/// adds the background to the film: these are distributed by their places in `order`, an equal share of the picture for each
/// node, so that no node has all of the sky. Nodes whose regions are empty get no rays. After a stop is requested it ends early,
/// with what it has.
std::vector<std::vector<PrimaryRun>> assign_primaries(const core::RenderSettings& settings, const Regions& partition,
                                                      const core::Pass& pass, const core::PixelMask& done,
                                                      const std::stop_token& stop = {}, const PixelOrder& order = {});

/// The number of runs that assign_primaries() would assign to each node, for each of `partitions` of one grid. Takes hardly
/// longer for many partitions than for one.
std::vector<std::vector<std::size_t>> count_primary_runs(const core::RenderSettings& settings,
                                                         std::span<const Regions> partitions, const core::Pass& pass,
                                                         const core::PixelMask& done, const std::stop_token& stop = {},
                                                         const PixelOrder& order = {});

/// The next primary ray to start: its number, and the samples by which it is numbered.
struct PrimaryStart {
  std::uint64_t number = 0;
  core::SampleRange samples;
};

/// A node's own primary rays, in its local memory: those assigned before the start, then packets of those that the host assigns
/// during the run. Thread safety: belongs to one node.
class Primaries {
 public:
  /// Copies `runs`, which are of the first pass. With `is_assigned` there is memory for assigned_packets afterwards.
  Primaries(nodes::LocalMemory& memory, std::span<const PrimaryRun> runs, const core::SampleRange& samples, bool is_assigned);
  /// The memory that the constructor takes.
  static nodes::Room<PrimaryRun> layout(std::size_t run_count, bool is_assigned);

  bool empty() const { return left_ == 0; }
  /// Number of rays that have not started.
  std::uint64_t left() const { return left_; }
  /// The samples by which the rays of this pass are numbered.
  const core::SampleRange& samples() const { return samples_; }
  /// The number of the next ray to start. Requires that one is left.
  std::uint64_t take();
  /// Adds a packet. Requires that none is left of an earlier pass.
  void put(const AssignedPrimaries& assigned);
  /// The number of packets whose memory has become free since the last call: as many more may come.
  std::uint32_t packets_worked_off();

 private:
  std::span<PrimaryRun> runs_;  ///< a ring
  std::size_t first_ = 0, count_ = 0;
  std::uint64_t started_of_run_ = 0;
  std::uint64_t left_ = 0;
  core::SampleRange samples_;
  std::uint32_t packets_ = 0;  ///< added, and not yet reported as worked off
};

}  // namespace dmpc::dataflow
