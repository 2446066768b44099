// The rays that have arrived at a node and wait there, and the return of the slots (credits) that they take.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/base/expect.h"
#include "dataflow/packets.h"
#include "dataflow/plan.h"
#include "dataflow/rays/ray_queue.h"
#include "dataflow/slots.h"
#include "nodes/layout.h"
#include "nodes/node.h"

namespace dmpc::dataflow {

/// The backlog and its accounts. `Units`: NoUnits or MovingUnits, which sends news together with credits. Thread safety: belongs
/// to one node.
template <class Units>
class Arrivals {
 public:
  /// `units` outlive this.
  Arrivals(nodes::Node& node, const Plan& plan, Units& units)
      : node_(&node),
        host_(plan.host()),
        units_(&units),
        tested_objects_(plan.tested_objects()),
        backlog_(node.memory(), backlog_capacity(plan)),
        slots_(node.memory(), slots_of(plan)) {}
  /// The memory that the constructor takes.
  static nodes::MemoryPlan layout(const Plan& plan) {
    return nodes::MemoryPlan(RayQueue::layout(backlog_capacity(plan))) + Slots::layout(slots_of(plan));
  }

  /// Takes a packet of rays, from a node or the host: calls came(message) for each.
  template <class Came>
  void take_packet(const nodes::Packet& packet, const Came& came) {
    const auto header = packet.front<RayPacketHeader>();
    core::expect(packet.payload.size() == ray_packet_bytes(header.count, tested_objects_),
                 "a packet of rays is as long as it says");
    core::expect(nodes::NodeId{header.owner} == node_->id(), "rays come to their owner");
    const std::uint32_t account = slots_.account_of(packet.source);
    const bool is_from_node = packet.source != host_;
    if (is_from_node) {
      units_->packet_came(packet.source, header);
    }
    backlog_.accept_packet(account, header.count);
    for (std::uint32_t i = 0; i < header.count; ++i) {
      const std::span<const std::byte> message = ray_bytes_in(packet.payload, i, tested_objects_);
      backlog_.put(account, message);
      if (is_from_node) {
        units_->ray_came(packet.source, message);
      }
      came(message);
    }
  }

  /// Removes the deepest ray, as RayQueue does; returns its slot if it is time.
  std::span<const std::byte> take() {
    std::uint32_t account = 0;
    const std::span<const std::byte> message = backlog_.take(account);
    give_back(account, false);
    return message;
  }
  bool has_alike() const { return backlog_.has_alike(); }
  /// Removes another ray of the same depth and kind.
  std::span<const std::byte> take_alike() {
    std::uint32_t account = 0;
    const std::span<const std::byte> message = backlog_.take_alike(account);
    give_back(account, false);
    return message;
  }

  /// To be called when a node asks for a shared slot.
  void take_ask(nodes::NodeId sender) {
    slots_.ask(sender);
    grant_slots();
  }
  /// To be called when a granted slot comes back unused.
  void take_unused() {
    slots_.give_back(1);
    grant_slots();
  }
  /// Returns all slots: a resting node keeps none.
  void give_all_back() {
    for (std::uint32_t account = 0; account < backlog_.sender_count(); ++account) {
      give_back(account, true);
    }
  }

  const RayQueue& backlog() const { return backlog_; }
  const Slots& slots() const { return slots_; }

 private:
  static Slots::Capacity slots_of(const Plan& plan) {
    return {.node_count = plan.node_count(),
            .shared = plan.ray_slots,
            .ray_credits = plan.ray_credits,
            .host_credits = plan.host_credits};
  }
  static RayQueue::Capacity backlog_capacity(const Plan& plan) {
    const std::uint32_t packets_each = std::max({plan.ray_credits, plan.ray_slots, plan.host_credits});
    return {.sender_count = slots_of(plan).account_count(),
            .packets_each = packets_each,
            .packets = plan.shares_slots() ? plan.ray_slots + plan.host_credits : plan.node_count() * packets_each,
            .ray_batch = plan.ray_batch,
            .depth_max = plan.request.depth_max,
            .are_kinds_apart = plan.rays_a_task > 1,
            .tested_objects = plan.tested_objects()};
  }

  void give_back(std::uint32_t account, bool rests) {
    const std::uint32_t owed = backlog_.owed(account);
    if (!slots_.gives_back(account, owed, rests)) {
      return;
    }
    backlog_.gave_back(account, owed);
    if (slots_.is_shared(account)) {
      slots_.give_back(owed);
      grant_slots();
    } else {
      send_credits(slots_.sender_of(account), owed);
    }
  }

  void grant_slots() {
    while (const std::optional<nodes::NodeId> sender = slots_.grant()) {
      send_credits(*sender, 1);
    }
  }

  void send_credits(nodes::NodeId sender, std::uint32_t count) {
    if (sender != host_) {
      units_->report_news(sender);
    }
    send_control(*node_, sender, Kind::credits, Credits{count});
  }

  nodes::Node* node_;
  nodes::NodeId host_;
  Units* units_;
  std::uint32_t tested_objects_;
  RayQueue backlog_;
  Slots slots_;
};

}  // namespace dmpc::dataflow
