// Reports the items on which programs work, twice a quantum: to observers, and to heat maps, to whose items it adds what a node
// counts meanwhile.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "nodes/charge.h"
#include "nodes/computer_request.h"
#include "nodes/machine.h"
#include "nodes/node_id.h"
#include "nodes/observer.h"
#include "nodes/observers/heat_map.h"
#include "nodes/observers/watching.h"

namespace dmpc::nodes {

/// A node's counts since the start, for heat maps.
struct HeatTotals {
  std::array<std::uint64_t, heat_kind_count> counts{};  ///< by kind; 0 for those that the computer defines
  Charges charges = {};

  std::uint64_t& operator[](HeatNumber kind) { return counts.at(kind.value()); }
};

/// One node's meter. Time is the price of the charged operations by a machine's model, or without one the processor time of the
/// calling thread, read twice a quantum. Thread safety: belongs to one node.
class Meter {
 public:
  /// For the members of `watching` that need one. `machine`, whose prices are time, outlives the meter, and so does the map;
  /// without a machine nodes are threads.
  Meter(const Watching& watching, const Machine* machine, NodeId self)
      : map_(watching.heat), observer_(watching.observer), self_(self), machine_(machine) {}

  /// What is counted and computed from now on is for one item.
  void begin(const HeatTotals& totals);
  /// Ends the item `item`, with the last depth in it. What follows, up to the next begin() if there is one, is for the item of
  /// the next end().
  void end(std::uint32_t item, std::uint32_t depth, const HeatTotals& totals);
  /// Records that the item belongs to this node.
  void claim(std::uint32_t item);

 private:
  std::uint64_t clock_ps() const;

  HeatMap* map_;
  Observer* observer_;
  NodeId self_;
  const Machine* machine_;
  HeatTotals before_;
  std::uint64_t clock_before_ps_ = 0;
};

/// The meter of node `self`, if one is wanted. `watching` and `computer` outlive it.
inline std::optional<Meter> meter_for(const Watching& watching, const ComputerRequest& computer, NodeId self) {
  return watching.is_metered() ? std::optional<Meter>(std::in_place, watching, computer.model(), self) : std::nullopt;
}

}  // namespace dmpc::nodes
