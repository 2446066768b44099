// What the virtual runner keeps of a message and of a node with all that belongs to it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <vector>

#include "core/base/expect.h"
#include "nodes/charge.h"
#include "nodes/local_memory.h"
#include "nodes/mailbox.h"
#include "nodes/node.h"
#include "nodes/observer.h"
#include "nodes/packet.h"
#include "nodes/program.h"
#include "nodes/runner.h"
#include "nodes/virtual/virtual_times.h"

namespace dmpc::nodes {

/// A message on its way, or at its target and not received.
struct Message {
  NodeId target{};
  PacketHeader header;
  std::vector<std::byte> payload;
  std::span<const std::byte> lasting;  ///< the payload's end, where it is, if the sender has said that it lasts
  MessageTimes times;                  ///< for an observer

  std::uint64_t bytes() const { return sizeof(PacketHeader) + header.bytes; }
  bool is_bulk() const { return header.bytes > small_payload_bytes; }
  Packet packet() const { return {NodeId{header.source}, header.kind, payload, lasting}; }
};

/// Messages by number; a number is used again, and so is its memory.
class MessageStore {
 public:
  std::uint32_t put(NodeId target, const PacketHeader& header, std::span<const std::byte> payload,
                    std::span<const std::byte> lasting) {
    if (free_.empty()) {
      free_.push_back(static_cast<std::uint32_t>(messages_.size()));
      messages_.emplace_back();
    }
    const std::uint32_t number = free_.back();
    free_.pop_back();
    Message& message = messages_[number];
    message.target = target;
    message.header = header;
    message.payload.assign(payload.begin(), payload.end());
    message.lasting = lasting;
    return number;
  }
  const Message& operator[](std::uint32_t number) const { return messages_[number]; }
  Message& operator[](std::uint32_t number) { return messages_[number]; }
  void release(std::uint32_t number) { free_.push_back(number); }
  bool empty() const { return free_.size() == messages_.size(); }

 private:
  std::deque<Message> messages_;  // whose addresses stay
  std::vector<std::uint32_t> free_;
};

/// From one node to another: messages keep their order, even a short one behind a long one.
struct Way {
  std::uint64_t last_enters_ns = 0, last_arrives_ns = 0;
};

struct VirtualProcessor;

/// What all processors of a computer have in common.
struct VirtualComputer {
  MessageStore messages;
  std::vector<std::unique_ptr<VirtualProcessor>> processors;
};

/// One node with all that belongs to it.
struct VirtualProcessor final : Network {
  VirtualProcessor(const NodeSpecification& specification, NodeId id, std::uint32_t peer_count, VirtualComputer& of)
      : computer(of),
        mailbox(specification.mailbox),
        interrupt_kinds(specification.interrupt_kinds),
        memory(specification.plan, Lasting::is_referred_to),
        node(id, peer_count, memory, *this),
        ways(peer_count) {
    static_cast<void>(memory.allocate<std::byte>(Category::mailbox, specification.mailbox.bytes()));  // the model's, unused
    program = specification.make_program(node);
    core::expect(program != nullptr, "a specification makes a program");
    memory.seal();
  }

  void deliver(NodeId target, const PacketHeader& header, std::span<const std::byte> payload) override {
    deliver_in_place(target, header, payload, {});
  }

  /// The sender's side: the message has its place in the target's mailbox from now on.
  bool deliver_in_place(NodeId target, const PacketHeader& header, std::span<const std::byte> front,
                        std::span<const std::byte> lasting) override {
    const std::uint32_t number = computer.messages.put(target, header, front, lasting);
    sent.push_back(number);
    VirtualProcessor& at = *computer.processors[index_of(target)];
    const bool is_bulk = computer.messages[number].is_bulk();
    std::uint32_t& held = is_bulk ? at.bulk_held : at.small_held;
    core::expect(++held <= (is_bulk ? at.mailbox.bulk_slots : at.mailbox.small_slots) &&
                     header.bytes <= std::max(small_payload_bytes, at.mailbox.bulk_payload_bytes),
                 "credits leave room in the target's mailbox");
    return true;
  }

  /// Lets the program receive a message of its mailbox.
  void receive(std::uint32_t number) {
    const Message& message = computer.messages[number];
    program->receive(message.packet());
    --(message.is_bulk() ? bulk_held : small_held);
    computer.messages.release(number);
  }

  VirtualComputer& computer;
  MailboxCapacity mailbox;
  std::uint32_t small_held = 0, bulk_held = 0;  ///< places of the mailbox that are taken
  std::uint32_t interrupt_kinds;
  LocalMemory memory;
  Node node;
  std::unique_ptr<Program> program;
  std::vector<std::uint32_t> sent;      ///< in the call that is going on, in order
  std::vector<std::uint32_t> outgoing;  ///< sent in a call whose operations are not done yet
  std::deque<std::uint32_t> inbox;      ///< arrived and not received
  std::vector<Way> ways;                ///< by target
  Charges charged;
  std::uint64_t remainder_ps = 0;  ///< charged, and not yet a whole nanosecond
  std::uint64_t sequence = 0;
  bool has_more = true;      ///< work() may have something to do
  bool is_occupied = false;  ///< an is_free event is under way
  std::uint64_t occupied_until_ns = 0;
  std::uint64_t served_until_ns = 0;  ///< the last interrupt
  std::uint64_t idle_since_ns = 0;
  std::uint64_t lent_before_ns = 0;  ///< times.lent_ns when it fell idle
  std::uint32_t calls = 0;           ///< of the program, if somebody looks on
  Span span, service;                ///< what it is doing and what it interrupted that for, likewise
  VirtualTimes times;
};

}  // namespace dmpc::nodes
