// The primary rays of a node whose region moves, unit by unit, so that those which have not started go along when a unit does.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "dataflow/packets.h"
#include "dataflow/regions/primary_run.h"
#include "nodes/layout.h"
#include "nodes/local_memory.h"

namespace dmpc::dataflow {

/// They start in the order of the picture, whatever their unit, as those of all other nodes do: so neighbours, whose rays meet,
/// are as far. Thread safety: belongs to one node.
class UnitPrimaries {
  struct List;

 public:
  struct Capacity {
    std::size_t units = 0;  ///< with rays at one time; 0: regions do not move, nothing is held
    std::size_t runs = 0;
  };

  /// Copies `runs`, those of one unit after the other, of which unit u has runs_of_unit[u].
  UnitPrimaries(nodes::LocalMemory& memory, const Capacity& capacity, std::span<const PrimaryRun> runs,
                std::span<const std::uint32_t> runs_of_unit, const core::SampleRange& samples);
  /// What the constructor takes.
  static nodes::Layout<PrimaryRun, List> layout(const Capacity& capacity);

  bool empty() const { return left_ == 0; }
  /// Rays.
  std::uint64_t left() const { return left_; }
  std::uint64_t left_of(std::uint32_t unit) const;
  std::size_t runs_of(std::uint32_t unit) const;
  /// So many may be put here of one unit: none unless all rays that were here have started.
  std::size_t free_runs() const { return empty() ? runs_.size() : 0; }
  const core::SampleRange& samples() const { return samples_; }

  /// The number of the next ray to start. Requires that one is left.
  std::uint64_t take();
  /// The unit with most rays. Requires that one is left.
  std::uint32_t largest_unit() const;
  /// Some of a unit's runs, as many as a packet holds, or none if there is none; they are here no longer.
  DealtPrimaries give(std::uint32_t unit);
  /// Some of a unit's runs have come, for all of which there was room before the first.
  void put(std::uint32_t unit, const DealtPrimaries& dealt);

 private:
  struct List {
    std::uint32_t unit = 0;
    std::uint32_t first = 0, count = 0;  ///< of runs
    std::uint64_t rays = 0;
  };
  List* find(std::uint32_t unit) const;

  std::span<PrimaryRun> runs_;
  std::span<List> lists_;
  std::uint64_t left_ = 0;
  core::SampleRange samples_;
};

}  // namespace dmpc::dataflow
