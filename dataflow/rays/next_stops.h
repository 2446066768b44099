// Which regions the rays of a bundle go to next: next_stop() for all of them at once.
#pragma once

#include <cstdint>

#include "core/trace/bundle.h"
#include "core/trace/operations.h"
#include "dataflow/rays/next_stop.h"
#include "nodes/node_id.h"

namespace dmpc::dataflow {

/// next_stop() for each ray of `bundle` that has left, with the same bits; `here` is the node that they are on. Those whose way
/// goes on keep their bits in bundle.left: bundle.passage() is how they enter the region of number region[ray]. The others'
/// bits are taken out: what they have found, if anything, is their nearest hit. Counts as a bundle does: what is looked up for
/// several is counted for each. Thread safety: pure but for the bundle and `operations`.
void find_next_stops(core::RayBundle& bundle, const Surroundings& surroundings, nodes::NodeId here, core::Operations& operations,
                     core::Row<std::uint32_t>& region);

}  // namespace dmpc::dataflow
