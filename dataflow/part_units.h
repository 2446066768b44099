// A node's part of the scene: if regions move, units with their pages, their primary rays and their migration from node to node;
// otherwise a fixed part.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/expect.h"
#include "core/picture/memory_use.h"
#include "core/record/records.h"
#include "dataflow/packets.h"
#include "dataflow/plan.h"
#include "dataflow/program.h"
#include "dataflow/rays/gather.h"
#include "dataflow/rays/primaries.h"
#include "dataflow/termination.h"
#include "dataflow/units/movement.h"
#include "dataflow/units/unit_pages.h"
#include "dataflow/units/unit_primaries.h"
#include "nodes/layout.h"
#include "nodes/node.h"

namespace dmpc::dataflow {

/// Thread safety: belongs to one node.
class MovingUnits {
 public:
  /// `header`, the whole database's, and `regions` outlive this.
  MovingUnits(nodes::Node& node, const Plan& plan, const NodeAssignment& assign, const core::DatabaseHeader& header,
              Regions& regions)
      : regions_(&regions),
        pages_(node.memory(), plan.pages_of_node(nodes::index_of(node.id()))),
        primaries_(node.memory(), plan.primaries_of_node(nodes::index_of(node.id())), assign.primaries, assign.runs_of_unit,
                   assign.settings.first_samples()),
        movement_(node, plan, {&header, &regions, &pages_, &primaries_}) {
    pages_.begin_with(assign.pages, assign.records);
  }
  MovingUnits(const MovingUnits&) = delete;
  MovingUnits& operator=(const MovingUnits&) = delete;
  /// The memory that the constructor takes at node `index`.
  static nodes::MemoryPlan layout(const Plan& plan, std::uint32_t index) {
    return UnitPages::layout(plan.pages_of_node(index)) + UnitPrimaries::layout(plan.primaries_of_node(index)) +
           Movement::layout(plan);
  }

  PartRecords records() const { return {{}, &pages_}; }
  /// The primary rays assigned before the start that belong to no unit.
  static std::span<const PrimaryRun> others_of(std::span<const PrimaryRun> /*primaries*/) { return {}; }

  /// The number of primary rays of units that are left.
  std::uint64_t primaries_left() const { return primaries_.left(); }
  /// The next primary ray to start: one of the others, or of a unit if there is none. Requires that one is left.
  PrimaryStart take_primary(Primaries& others) {
    return others.empty() ? PrimaryStart{primaries_.take(), primaries_.samples()} : PrimaryStart{others.take(), others.samples()};
  }

  /// To be called when rays have come from any node or the host.
  void rays_came() { movement_.rays_came(); }
  /// To be called for a packet of rays from a node, before its rays.
  void packet_came(nodes::NodeId sender, const RayPacketHeader& header) { movement_.take_rays_left(sender, header.rays_left); }
  void ray_came(nodes::NodeId sender, std::span<const std::byte> bytes) {
    if (is_others(bytes)) {
      movement_.is_behind(sender, unit_of(bytes));
    }
  }
  /// Whether the unit that the ray enters has migrated, and the sender did not know.
  bool is_others(std::span<const std::byte> message) const {
    return !is_confirmed_in(message) && !movement_.answers_for(unit_of(message));
  }
  /// To be called when such a ray is forwarded to another node.
  void sent_on() { movement_.sent_on(); }
  /// Sends news before credits for a node, so that there is a slot for it: it has been taken before the credits allow more of it.
  void report_news(nodes::NodeId sender) { movement_.report_news(sender); }
  /// Packets of rays report how many primary rays could be migrated.
  void report_left(Gather& gather) const { gather.report(movement_.rays_left()); }

  bool is_settled() const { return movement_.is_settled(); }
  bool wants_to_ask() const { return movement_.wants_to_ask(); }
  void ask() { movement_.ask(); }
  /// Packets that may set this node going count as packets of rays for termination detection.
  void receive(const nodes::Packet& packet, Termination& termination) {
    if (Kind{packet.kind} == Kind::unit_moved) {
      return movement_.take_news(packet.as<UnitMoved>());
    }
    termination.ray_packet_received();
    if (movement_.receive(packet)) {
      termination.ray_packet_sent();
    }
  }

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
  UnitPrimaries primaries_;  ///< assigned before the start
  Movement movement_;
};

/// For regions that do not move: the node's part in one piece. Has the functions of MovingUnits, which do nothing here.
class NoUnits {
 public:
  NoUnits(nodes::Node& node, const Plan& /*plan*/, const NodeAssignment& assign, const core::DatabaseHeader& /*header*/,
          Regions& /*regions*/)
      : part_(room(assign.records.size_bytes()).in(node.memory())) {
    assign.records.copy(0, part_);
  }
  static nodes::MemoryPlan layout(const Plan& plan, std::uint32_t index) {
    return room(plan.request.shares[index].part_bytes + core::overread_bytes);
  }

  PartRecords records() const { return {part_, nullptr}; }
  static std::span<const PrimaryRun> others_of(std::span<const PrimaryRun> primaries) { return primaries; }

  std::uint64_t primaries_left() const { return 0; }
  static PrimaryStart take_primary(Primaries& others) { return {others.take(), others.samples()}; }

  void rays_came() {}
  void packet_came(nodes::NodeId /*sender*/, const RayPacketHeader& /*header*/) {}
  void ray_came(nodes::NodeId /*sender*/, std::span<const std::byte> /*message*/) {}
  bool is_others(std::span<const std::byte> /*message*/) const { return false; }
  void sent_on() {}
  void report_news(nodes::NodeId /*sender*/) {}
  void report_left(Gather& /*gather*/) const {}

  bool is_settled() const { return true; }
  bool wants_to_ask() const { return false; }
  void ask() {}
  void receive(const nodes::Packet& /*packet*/, Termination& /*termination*/) {
    core::expect(false, "a node receives only what is sent to nodes");
  }

  MovementCounters counters() const { return {}; }
  void add_charges(nodes::Charges& /*charges*/) const {}

 private:
  static nodes::Room<std::byte> room(std::size_t bytes) { return {core::MemoryUse::home_pages, bytes}; }

  std::span<std::byte> part_;
};

}  // namespace dmpc::dataflow
