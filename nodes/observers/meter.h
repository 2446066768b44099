// What programs tell of the items that they work on, asked for twice a quantum: for observers, and for heat maps, onto whose item
// it puts what a node counts meanwhile.
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

/// What a node has counted since the start, as far as heat maps show it.
struct HeatTotals {
  std::array<std::uint64_t, heat_kind_count> counts{};  ///< by kind; 0 of those that the computer knows
  Charges charges = {};

  std::uint64_t& operator[](HeatNumber kind) { return counts.at(kind.value()); }
};

/// One node's. Time is what a machine's model asks for the operations charged, or without one the processor's time of the calling
/// thread, read twice a quantum. Thread safety: belongs to one node.
class Meter {
 public:
  /// For whoever of `watching` wants one. `machine`, whose prices are time, outlives the meter, and so does the map; without a
  /// machine nodes are threads.
  Meter(const Watching& watching, const Machine* machine, NodeId self)
      : map_(watching.heat), observer_(watching.observer), self_(self), machine_(machine) {}

  /// What is counted and computed from now on is for one item.
  void begin(const HeatTotals& totals);
  /// It was for this one, and the call got so deep in it last. What follows, up to the next begin() if there is one, is for
  /// the item of the next end().
  void end(std::uint32_t item, std::uint32_t depth, const HeatTotals& totals);
  /// The item belongs to this node.
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
