#include "nodes/threads/delayed_packets.h"

#include <algorithm>
#include <cstring>
#include <type_traits>

#include "core/base/expect.h"
#include "core/base/units.h"
#include "nodes/packet.h"

namespace dmpc::nodes {

std::size_t DelayedPackets::bytes_for(std::size_t payload_bytes) {
  static_assert(std::is_trivially_copyable_v<Held>);
  return sizeof(Held) + core::round_up(payload_bytes, sizeof(std::uint64_t));
}

std::size_t DelayedPackets::room_bytes(std::size_t payload_bytes_max) {
  return LocalMemory::bytes_for<std::byte>(4 * bytes_for(payload_bytes_max) + 16 * bytes_for(small_payload_bytes));
}

DelayedPackets::DelayedPackets(const Chaos& chaos, NodeId source, LocalMemory& memory, std::size_t room_bytes, Network& network)
    : delays_(chaos, source), network_(&network), room_(memory.allocate<std::byte>(Category::queues, room_bytes)) {}

void DelayedPackets::deliver(NodeId target, const PacketHeader& header, std::span<const std::byte> payload) {
  core::expect(header.bytes == payload.size(), "a header says how long its payload is");
  core::expect(bytes_for(payload.size()) <= room_.size(), "a packet fits the room for those held back");
  const std::uint64_t due_quantum = std::max(quantum_ + delays_.next_quanta(target), last_due_quantum(target));
  if (due_quantum == quantum_) {
    network_->deliver(target, header, payload);
  } else {
    append({due_quantum, target, header}, payload);
  }
}

void DelayedPackets::pass_quantum() {
  ++quantum_;
  std::size_t kept_bytes = 0;
  for (std::size_t offset = 0; offset < used_bytes_;) {
    const Held held = held_at(offset);
    if (held.due_quantum <= quantum_) {
      hand_on(offset);
    } else {
      std::memmove(room_.data() + kept_bytes, room_.data() + offset, held.bytes());
      kept_bytes += held.bytes();
    }
    offset += held.bytes();
  }
  used_bytes_ = kept_bytes;
}

DelayedPackets::Held DelayedPackets::held_at(std::size_t offset) const {
  Held held;
  std::memcpy(&held, room_.data() + offset, sizeof(held));
  return held;
}

std::uint64_t DelayedPackets::last_due_quantum(NodeId target) const {
  std::uint64_t last = 0;
  for (std::size_t offset = 0; offset < used_bytes_; offset += held_at(offset).bytes()) {
    const Held held = held_at(offset);
    last = held.target == target ? held.due_quantum : last;
  }
  return last;
}

void DelayedPackets::append(const Held& held, std::span<const std::byte> payload) {
  while (room_.size() - used_bytes_ < held.bytes()) {
    hand_on_oldest();
  }
  std::byte* const place = room_.data() + used_bytes_;
  std::memcpy(place, &held, sizeof(held));
  if (!payload.empty()) {
    std::memcpy(place + sizeof(held), payload.data(), payload.size());
  }
  used_bytes_ += held.bytes();
  ++count_;
}

void DelayedPackets::hand_on(std::size_t offset) {
  const Held held = held_at(offset);
  network_->deliver(held.target, held.header, room_.subspan(offset + sizeof(held), held.header.bytes));
}

void DelayedPackets::hand_on_oldest() {
  hand_on(0);
  const std::size_t bytes = held_at(0).bytes();
  used_bytes_ -= bytes;
  std::memmove(room_.data(), room_.data() + bytes, used_bytes_);
}

}  // namespace dmpc::nodes
