// What a node's program has where regions stay whose they are: its part in one piece, and nothing of units.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/expect.h"
#include "core/picture/memory_use.h"
#include "core/record/records.h"
#include "dataflow/node_deal.h"
#include "dataflow/packets.h"
#include "dataflow/plan.h"
#include "dataflow/rays/gather.h"
#include "dataflow/rays/primaries.h"
#include "dataflow/termination.h"
#include "dataflow/units/movement.h"
#include "dataflow/units/unit_pages.h"
#include "nodes/layout.h"
#include "nodes/node.h"

namespace dmpc::dataflow {

/// Has the functions of MovingUnits, which do nothing here.
class NoUnits {
 public:
  NoUnits(nodes::Node& node, const Plan& /*plan*/, const NodeDeal& deal, const core::DatabaseHeader& /*header*/,
          Regions& /*regions*/)
      : part_(room(deal.records.size_bytes()).in(node.memory())) {
    deal.records.copy(0, part_);
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
  void tell_news(nodes::NodeId /*sender*/) {}
  void tell_left(Gather& /*gather*/) const {}

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
