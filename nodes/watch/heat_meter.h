// Puts what a node counts while it works on a pixel onto that pixel of a heat map.
#pragma once

#include <cstdint>

#include "nodes/charge.h"
#include "nodes/machine.h"
#include "nodes/node_id.h"
#include "nodes/watch/heat_map.h"

namespace dmpc::nodes {

/// What a node has counted since the start, as far as heat maps show it.
struct HeatTotals {
  std::uint64_t rays = 0, references = 0, faults = 0, pages = 0;
  Charges charges = {};
};

/// One node's. Time is what a machine's model asks for the operations charged, or without one the processor's time of the calling
/// thread, read twice a quantum. Thread safety: belongs to one node.
class HeatMeter {
 public:
  /// `map` and `machine` outlive the meter; without a machine the node is a thread.
  HeatMeter(HeatMap& map, NodeId self, const Machine* machine) : map_(&map), self_(self), machine_(machine) {}

  /// What is counted and computed from now on is for one pixel.
  void begin(const HeatTotals& totals);
  /// It was for this one, and a ray of this depth was the newest. What follows, up to the next begin() if there is one, is for
  /// the pixel of the next end().
  void end(std::uint32_t pixel, std::uint32_t depth, const HeatTotals& totals);
  /// The pixel belongs to this node.
  void claim(std::uint32_t pixel) { map_->set(HeatKind::node, pixel, index_of(self_)); }

 private:
  std::uint64_t clock_ps() const;

  HeatMap* map_;
  NodeId self_;
  const Machine* machine_;
  HeatTotals before_;
  std::uint64_t clock_before_ps_ = 0;
};

}  // namespace dmpc::nodes
