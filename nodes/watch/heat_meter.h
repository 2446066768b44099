// Puts what a node counts while it works on an item onto that item of a heat map.
#pragma once

#include <array>
#include <cstdint>

#include "nodes/charge.h"
#include "nodes/machine.h"
#include "nodes/node_id.h"
#include "nodes/watch/heat_map.h"

namespace dmpc::nodes {

/// What a node has counted since the start, as far as heat maps show it.
struct HeatTotals {
  std::array<std::uint64_t, heat_kind_count> counts{};  ///< by kind; 0 of those that the computer knows
  Charges charges = {};

  std::uint64_t& operator[](HeatNumber kind) { return counts.at(kind.value()); }
};

/// One node's. Time is what a machine's model asks for the operations charged, or without one the processor's time of the calling
/// thread, read twice a quantum. Thread safety: belongs to one node.
class HeatMeter {
 public:
  /// `map` and `machine` outlive the meter; without a machine the node is a thread.
  HeatMeter(HeatMap& map, NodeId self, const Machine* machine) : map_(&map), self_(self), machine_(machine) {}

  /// What is counted and computed from now on is for one item.
  void begin(const HeatTotals& totals);
  /// It was for this one, and the call got so deep in it last. What follows, up to the next begin() if there is one, is for
  /// the item of the next end().
  void end(std::uint32_t item, std::uint32_t depth, const HeatTotals& totals);
  /// The item belongs to this node.
  void claim(std::uint32_t item) { map_->set(map_->node(), item, index_of(self_)); }

 private:
  std::uint64_t clock_ps() const;

  HeatMap* map_;
  NodeId self_;
  const Machine* machine_;
  HeatTotals before_;
  std::uint64_t clock_before_ps_ = 0;
};

}  // namespace dmpc::nodes
