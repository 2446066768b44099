// The next region for a ray: skips those where it hits nothing, up to the first where it may hit something.
#pragma once

#include <cstdint>
#include <optional>

#include "core/record/records.h"
#include "core/trace/bundle.h"
#include "core/trace/operations.h"
#include "core/trace/skips.h"
#include "core/trace/traversal.h"
#include "dataflow/regions/regions.h"
#include "nodes/node_id.h"

namespace dmpc::dataflow {

/// The destination of a ray.
struct NextStop {
  /// left: it goes on in `region`. hit: its candidate is the nearest, proved within empty regions. miss: it leaves the grid.
  core::Traced traced = core::Traced::left;
  core::Passage passage;     ///< how it enters `region`
  std::uint32_t region = 0;  ///< by number; meaningless unless it goes on
};

/// Data about all of space.
struct Surroundings {
  const Regions& regions;
  const core::DatabaseHeader& proxy;  ///< the database's proxy's (core/database/proxy.h); without a directory if there is none
  core::LocalRecords records;         ///< the proxy's
  core::Skips skips;

  bool has_proxy() const { return proxy.directory != core::no_address; }
};

/// The next stop of a ray that enters the grid, or leaves a region, by `passage`; it always stops in a region of node `here`,
/// since that costs no message. Same bits as if every region were visited. Thread safety: pure except for the steps, BVH nodes
/// and skipped regions that it adds to `operations`.
NextStop next_stop(const core::Ray& ray, const core::Passage& passage, const Surroundings& surroundings,
                   std::optional<nodes::NodeId> here, core::Operations& operations);

/// next_stop() for each ray of `bundle` that has left, with the same bits; `here` is their node. Those that go on keep their bits
/// in bundle.left: bundle.passage() is how they enter region number region[ray]. The others' bits are cleared: what they have
/// found, if anything, is their nearest hit. Counts like a bundle: a look-up for several rays is counted for each. Thread safety:
/// pure except for the bundle and `operations`.
void find_next_stops(core::RayBundle& bundle, const Surroundings& surroundings, nodes::NodeId here, core::Operations& operations,
                     core::Row<std::uint32_t>& region);

}  // namespace dmpc::dataflow
