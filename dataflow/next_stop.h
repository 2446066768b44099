// Which region a ray goes to next: past those that hold nothing, to the first that holds something.
#pragma once

#include <cstdint>

#include "core/trace/operations.h"
#include "core/trace/traversal.h"
#include "dataflow/regions/bsp.h"

namespace dmpc::dataflow {

/// Where a ray's way leads.
struct NextStop {
  /// left: it goes on in `region`. hit: its candidate is the nearest, proved where nothing is. miss: it leaves the grid.
  core::Traced traced = core::Traced::left;
  core::Passage passage;     ///< how it enters `region`
  std::uint32_t region = 0;  ///< by number; without meaning unless it goes on
};

/// The way of a ray that enters the grid, or leaves a region, by `passage`. Same bits as if every region were asked. Thread
/// safety: pure but for the steps and skipped regions that it adds to `operations`.
NextStop next_stop(const core::Ray& ray, const core::Passage& passage, const core::GridFrame& frame, const Bsp& bsp,
                   core::Operations& operations);

}  // namespace dmpc::dataflow
