// Which region a ray goes to next: past those where it meets nothing, to the first where it may meet something.
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

/// Where a ray's way leads.
struct NextStop {
  /// left: it goes on in `region`. hit: its candidate is the nearest, proved where nothing is. miss: it leaves the grid.
  core::Traced traced = core::Traced::left;
  core::Passage passage;     ///< how it enters `region`
  std::uint32_t region = 0;  ///< by number; without meaning unless it goes on
};

/// What is known of all of space.
struct Surroundings {
  const Regions& regions;
  const core::DatabaseHeader& proxy;  ///< of the database's proxy (core/database/proxy.h); without a directory: none is known
  core::LocalRecords records;         ///< the proxy's
  core::Skips skips;

  bool has_proxy() const { return proxy.directory != core::no_address; }
};

/// The way of a ray that enters the grid, or leaves a region, by `passage`; in a region of node `here`'s it stops in any case,
/// since nobody need be asked. Same bits as if every region were asked. Thread safety: pure except for the steps, BVH nodes and
/// skipped regions that it adds to `operations`.
NextStop next_stop(const core::Ray& ray, const core::Passage& passage, const Surroundings& surroundings,
                   std::optional<nodes::NodeId> here, core::Operations& operations);

/// next_stop() for each ray of `bundle` that has left, with the same bits; `here` is the node that they are on. Those whose way
/// goes on keep their bits in bundle.left: bundle.passage() is how they enter the region of number region[ray]. The others'
/// bits are taken out: what they have found, if anything, is their nearest hit. Counts as a bundle does: what is looked up for
/// several is counted for each. Thread safety: pure except for the bundle and `operations`.
void find_next_stops(core::RayBundle& bundle, const Surroundings& surroundings, nodes::NodeId here, core::Operations& operations,
                     core::Row<std::uint32_t>& region);

}  // namespace dmpc::dataflow
