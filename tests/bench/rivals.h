// Queues that carry packets from many senders to one receiver: ours and a baseline of equal guarantee, each with the same few
// functions.
//
// Both are lock-free and bounded, refuse when they are full, keep the order of each sender, allocate nothing after the start, and
// move packets of a size that the compiler knows by copying. The baseline's receiver copies once more, out of the queue, where
// ours reads in the slot; it offers nothing else.
#pragma once

#include <array>
#include <boost/lockfree/queue.hpp>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/expect.h"
#include "nodes/mailbox.h"

namespace dmpc::bench {

/// So many packets a queue has room for, at least.
inline constexpr std::uint32_t queue_capacity = 256;

/// What is sent: as large as the payload of a small packet, or as a page.
template <std::size_t payload_bytes>
struct Message {
  std::uint32_t sender = 0;
  std::uint32_t number = 0;  ///< of this sender's, from 0
  std::array<std::byte, payload_bytes - 12> filling{};
  std::uint32_t check = 0;  ///< check_of(sender, number): half a message is not taken for a whole one
};

constexpr std::uint32_t check_of(std::uint32_t sender, std::uint32_t number) { return (sender + 1) * 0x9e3779b1U ^ number; }

/// Ours, with a place to sleep that the other has not. Each of them has the functions push() and drain().
template <class T>
class OwnQueue {
 public:
  static constexpr const char* name = "nodes::Mailbox";

  explicit OwnQueue(std::uint32_t sender_count) : memory_(plan()), mailbox_(capacity(), memory_), awake_(sender_count + 1) {}

  /// Pushes a message of the sender with this number; false if it is full.
  bool push(std::uint32_t sender, const T& message) {
    const nodes::PacketHeader header{.bytes = sizeof(T), .source = static_cast<std::uint16_t>(sender)};
    return mailbox_.push(header, std::as_bytes(std::span(&message, 1)), awake_);
  }
  /// Calls receive(message) for all that are there; false if there is none.
  template <class Receive>
  bool drain(Receive&& receive) {
    return mailbox_.drain([&](const nodes::Packet& packet) { receive(*reinterpret_cast<const T*>(packet.payload.data())); }) > 0;
  }
  /// Blocks until there is a message.
  void sleep() {
    if (mailbox_.fall_asleep()) {
      static_cast<void>(awake_.leave());
      mailbox_.wait();
    }
  }

 private:
  static constexpr bool is_small = sizeof(T) <= nodes::small_payload_bytes;
  static constexpr nodes::MailboxCapacity capacity() {
    return is_small ? nodes::MailboxCapacity{.small_slots = queue_capacity}
                    : nodes::MailboxCapacity{.bulk_slots = queue_capacity, .bulk_payload_bytes = sizeof(T)};
  }
  static nodes::MemoryPlan plan() {
    nodes::MemoryPlan plan;
    plan[nodes::Category::mailbox] = capacity().bytes();
    return plan;
  }

  nodes::LocalMemory memory_;
  nodes::Mailbox mailbox_;
  nodes::AwakeCount awake_;
};

template <class T>
class BoostQueue {
 public:
  static constexpr const char* name = "boost::lockfree::queue";

  explicit BoostQueue(std::uint32_t /*sender_count*/) {}

  bool push(std::uint32_t /*sender*/, const T& message) { return queue_.bounded_push(message); }
  template <class Receive>
  bool drain(Receive&& receive) {
    return queue_.consume_all(receive) > 0;
  }

 private:
  boost::lockfree::queue<T, boost::lockfree::capacity<queue_capacity>> queue_;
};

}  // namespace dmpc::bench
