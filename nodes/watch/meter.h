// What programs tell of the items that they work on, asked for twice a quantum.
#pragma once

#include <cstdint>
#include <optional>

#include "nodes/computer_request.h"
#include "nodes/node_id.h"
#include "nodes/observer.h"
#include "nodes/watch/heat_meter.h"
#include "nodes/watch/watching.h"

namespace dmpc::nodes {

/// One node's. Thread safety: belongs to one node.
class Meter {
 public:
  /// For whoever of `watching` wants one. `machine`, whose prices are time, outlives the meter; without it nodes are threads.
  Meter(const Watching& watching, const Machine* machine, NodeId self) : observer_(watching.observer), self_(self) {
    if (watching.heat != nullptr) {
      heat_.emplace(*watching.heat, self, machine);
    }
  }

  /// What is counted and computed from now on is for one item.
  void begin(const HeatTotals& totals) {
    if (heat_) {
      heat_->begin(totals);
    }
  }
  /// It was for this one, and the call got so deep in it last. What follows, up to the next begin() if there is one, is for
  /// the item of the next end().
  void end(std::uint32_t item, std::uint32_t depth, const HeatTotals& totals) {
    if (heat_) {
      heat_->end(item, depth, totals);
    }
    if (observer_ != nullptr) {
      observer_->worked({self_, item, depth});
    }
  }
  /// The item belongs to this node.
  void claim(std::uint32_t item) {
    if (heat_) {
      heat_->claim(item);
    }
  }

 private:
  std::optional<HeatMeter> heat_;
  Observer* observer_;
  NodeId self_;
};

/// The meter of node `self`, if one is wanted. `watching` and `computer` outlive it.
inline std::optional<Meter> meter_for(const Watching& watching, const ComputerRequest& computer, NodeId self) {
  return watching.is_metered() ? std::optional<Meter>(std::in_place, watching, computer.model(), self) : std::nullopt;
}

}  // namespace dmpc::nodes
