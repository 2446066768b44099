// What a node's program has where regions move: units, with their pages, their primary rays and their way from node to node.
#pragma once

#include <cstdint>
#include <span>

#include "dataflow/node_deal.h"
#include "dataflow/packets.h"
#include "dataflow/plan.h"
#include "dataflow/rays/gather.h"
#include "dataflow/rays/primaries.h"
#include "dataflow/termination.h"
#include "dataflow/units/movement.h"
#include "dataflow/units/unit_pages.h"
#include "dataflow/units/unit_primaries.h"
#include "nodes/node.h"

namespace dmpc::dataflow {

/// Thread safety: belongs to one node.
class MovingUnits {
 public:
  /// `header`, the whole database's, and `regions` outlive this.
  MovingUnits(nodes::Node& node, const Plan& plan, const NodeDeal& deal, const core::DatabaseHeader& header, Regions& regions);
  MovingUnits(const MovingUnits&) = delete;
  MovingUnits& operator=(const MovingUnits&) = delete;
  /// What the constructor takes at node `index`.
  static nodes::MemoryPlan layout(const Plan& plan, std::uint32_t index);

  PartRecords records() const { return {{}, &pages_}; }
  /// Those of the primary rays dealt before the start that are of no unit.
  static std::span<const PrimaryRun> others_of(std::span<const PrimaryRun> /*primaries*/) { return {}; }

  /// How many primary rays of units are left.
  std::uint64_t primaries_left() const { return primaries_.left(); }
  /// The next primary ray to start: one of the others, or of a unit if there is none. Requires that one is left.
  PrimaryStart take_primary(Primaries& others) {
    return others.empty() ? PrimaryStart{primaries_.take(), primaries_.samples()} : PrimaryStart{others.take(), others.samples()};
  }

  /// From any node or the host.
  void rays_came() { movement_.rays_came(); }
  /// A packet of rays from a node; its rays are next.
  void packet_came(nodes::NodeId sender, const RayPacketHeader& header) { movement_.take_rays_left(sender, header.rays_left); }
  void ray_came(nodes::NodeId sender, std::span<const std::byte> bytes) {
    if (is_others(bytes)) {
      movement_.is_behind(sender, unit_of(bytes));
    }
  }
  /// The unit that the ray enters has moved on, and the sender did not know.
  bool is_others(std::span<const std::byte> message) const {
    return !is_confirmed_in(message) && !movement_.answers_for(unit_of(message));
  }
  /// Such a ray goes to another node.
  void sent_on() { movement_.sent_on(); }
  /// Ahead of credits for a node, so that there is room for it: it has been taken before the credits let more of it arise.
  void tell_news(nodes::NodeId sender) { movement_.tell_news(sender); }
  /// Packets of rays say how many primary rays could be handed over.
  void tell_left(Gather& gather) const { gather.tell(movement_.rays_left()); }

  bool is_settled() const { return movement_.is_settled(); }
  bool wants_to_ask() const { return movement_.wants_to_ask(); }
  void ask() { movement_.ask(); }
  /// What may set this node going counts as a packet of rays for the proof of the end.
  void receive(const nodes::Packet& packet, Termination& termination);

  MovementCounters counters() const { return movement_.counters(); }
  void add_charges(nodes::Charges& charges) const { movement_.add_charges(charges); }

 private:
  std::uint32_t unit_of(std::span<const std::byte> message) const {
    core::Corner cell;
    get_field(message, offsetof(RayMessage, cell), cell);
    return regions_->region_index_of(cell);
  }

  Regions* regions_;
  UnitPages pages_;
  UnitPrimaries primaries_;  ///< those dealt before the start
  Movement movement_;
};

}  // namespace dmpc::dataflow
