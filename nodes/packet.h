// What one node sends another: a small header and a bounded payload, without pointers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

#include "core/base/expect.h"
#include "nodes/node_id.h"

namespace dmpc::nodes {

/// A node program's own numbering of its packets, below packet_kind_count.
using PacketKind = std::uint8_t;
inline constexpr std::size_t packet_kind_count = 24;

struct PacketHeader {
  std::uint32_t bytes = 0;   ///< payload, including its immutable end
  std::uint16_t source = 0;  ///< index of the sending NodeId
  PacketKind kind = 0;
  std::uint8_t end_in_place = 0;  ///< 1: a mailbox's slot has the address of the immutable end, not its bytes
};
static_assert(sizeof(PacketHeader) == 8 && std::is_trivially_copyable_v<PacketHeader>);

/// A slot of a mailbox's small pool holds a header and this payload; anything longer takes a bulk slot.
inline constexpr std::size_t small_slot_bytes = 64;
inline constexpr std::size_t small_payload_bytes = small_slot_bytes - sizeof(PacketHeader);

/// Payload types that fit a small slot.
template <class T>
inline constexpr bool is_small_packet = std::is_trivially_copyable_v<T> && sizeof(T) <= small_payload_bytes;

/// A received packet: valid only during the call of Program::receive().
struct Packet {
  NodeId source{};
  PacketKind kind = 0;
  std::span<const std::byte> payload;
  /// The immutable end of the payload, if it was sent so and the runner delivers it by address. Otherwise it is the end of
  /// `payload`.
  std::span<const std::byte> immutable = {};

  std::size_t payload_bytes() const { return payload.size() + immutable.size(); }
  /// The payload after the first `front_bytes`, wherever it is stored: the immutable end, if the packet was sent so.
  std::span<const std::byte> behind(std::size_t front_bytes) const {
    return immutable.empty() ? payload.subspan(front_bytes) : immutable;
  }

  /// The payload as one value of a trivially copyable type; expects that the size is right.
  template <class T>
  T as() const {
    core::expect(payload.size() == sizeof(T), "a packet has the size of its kind");
    return front<T>();
  }
  /// The first value of a longer payload; expects that the payload is long enough.
  template <class T>
  T front() const {
    static_assert(std::is_trivially_copyable_v<T>);
    core::expect(payload.size() >= sizeof(T), "a packet has the header of its kind");
    T value;
    std::memcpy(&value, payload.data(), sizeof(T));
    return value;
  }
};

}  // namespace dmpc::nodes
