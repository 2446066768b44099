// The virtual runner's data of a message and of a node.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/base/expect.h"
#include "core/base/zeroed_array.h"
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

/// A message in flight, or at its target and not received.
struct Message {
  NodeId target{};
  PacketHeader header;
  std::vector<std::byte> payload;
  std::span<const std::byte> immutable;  ///< the payload's immutable end, by address, if the sender sent it so
  std::uint32_t next = 0;                ///< in a MessageQueue
  MessageTimes times;                    ///< for an observer

  std::uint64_t bytes() const { return sizeof(PacketHeader) + header.bytes; }
  bool is_bulk() const { return header.bytes > small_payload_bytes; }
  Packet packet() const { return {NodeId{header.source}, header.kind, payload, immutable}; }
};

/// Messages by number; numbers and their memory are reused.
class MessageStore {
 public:
  std::uint32_t put(NodeId target, const PacketHeader& header, std::span<const std::byte> payload,
                    std::span<const std::byte> immutable) {
    if (free_.empty()) {
      add_block();
    }
    const std::uint32_t number = free_.back();
    free_.pop_back();
    Message& message = (*this)[number];
    message.target = target;
    message.header = header;
    message.payload.assign(payload.begin(), payload.end());
    message.immutable = immutable;
    return number;
  }
  const Message& operator[](std::uint32_t number) const { return blocks_[number / block_size][number % block_size]; }
  Message& operator[](std::uint32_t number) { return blocks_[number / block_size][number % block_size]; }
  void release(std::uint32_t number) { free_.push_back(number); }
  bool empty() const { return free_.size() == blocks_.size() * block_size; }

 private:
  static constexpr std::uint32_t block_size = 64;

  void add_block() {
    const auto first = static_cast<std::uint32_t>(blocks_.size()) * block_size;
    blocks_.push_back(std::make_unique<Message[]>(block_size));
    for (std::uint32_t i = block_size; i > 0; --i) {
      free_.push_back(first + i - 1);
    }
  }

  std::vector<std::unique_ptr<Message[]>> blocks_;  ///< so that addresses of messages are stable
  std::vector<std::uint32_t> free_;
};

/// Messages of a store, in the order of arrival; each is in at most one queue.
class MessageQueue {
 public:
  bool empty() const { return count_ == 0; }
  void push(MessageStore& store, std::uint32_t number) {
    (empty() ? first_ : store[last_].next) = number;
    last_ = number;
    ++count_;
  }
  /// Removes the oldest. Requires that there is one.
  std::uint32_t pop(const MessageStore& store) {
    core::expect(!empty(), "a message is taken that has come");
    --count_;
    return std::exchange(first_, store[first_].next);
  }

 private:
  std::uint32_t first_ = 0, last_ = 0, count_ = 0;
};

/// From one node to another: messages keep their order, even a short one after a long one.
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
struct alignas(64) VirtualProcessor final : Network {
  VirtualProcessor(const NodeSpecification& specification, NodeId name, std::uint32_t peer_count, VirtualComputer& of)
      : computer(of),
        id(name),
        mailbox(specification.mailbox),
        interrupt_kinds(specification.interrupt_kinds),
        ways(peer_count),
        memory(specification.plan, Immutable::is_referred_to),
        node(id, peer_count, memory, *this) {
    static_cast<void>(memory.allocate<std::byte>(Category::mailbox, specification.mailbox.bytes()));  // the model's, unused
    program = specification.make_program(node);
    core::expect(program != nullptr, "a specification makes a program");
    memory.seal();
  }

  void deliver(NodeId target, const PacketHeader& header, std::span<const std::byte> payload) override {
    deliver_in_place(target, header, payload, {});
  }

  /// The sender's side: the message has its slot in the target's mailbox from now on.
  bool deliver_in_place(NodeId target, const PacketHeader& header, std::span<const std::byte> front,
                        std::span<const std::byte> immutable) override {
    const std::uint32_t number = computer.messages.put(target, header, front, immutable);
    sent.push_back(number);
    VirtualProcessor& at = *computer.processors[index_of(target)];
    const bool is_bulk = computer.messages[number].is_bulk();
    std::uint32_t& held = is_bulk ? at.bulk_held : at.small_held;
    core::expect(++held <= (is_bulk ? at.mailbox.bulk_slots : at.mailbox.small_slots) &&
                     header.bytes <= std::max(small_payload_bytes, at.mailbox.bulk_payload_bytes),
                 "credits leave room in the target's mailbox");
    return true;
  }

  ~VirtualProcessor() override { program.reset(); }  // its data lies in memory

  /// To be called before another run, for a program whose charges so far have this price.
  void begin_again(std::uint64_t price_ps) {
    sequence = occupied_until_ns = remainder_ps = served_until_ns = idle_since_ns = service_idle_before_ns = calls = 0;
    charged_ps = price_ps;
    charged = program->charges();
    has_more = true;
    times = {};
    ways = core::ZeroedArray<Way>(ways.size());
    node.counters() = {};
  }

  /// Lets the program receive a message of its mailbox.
  void receive(std::uint32_t number) {
    const Message& message = computer.messages[number];
    program->receive(message.packet());
    --(message.is_bulk() ? bulk_held : small_held);
    computer.messages.release(number);
  }

  VirtualComputer& computer;

  // Data that each quantum reads or writes, on few cache lines: with many nodes it is seldom still in the real processor's cache.
  std::unique_ptr<Program> program;
  std::uint64_t sequence = 0;
  std::uint64_t occupied_until_ns = 0;
  std::uint64_t charged_ps = 0;    ///< the price of all charges
  std::uint64_t remainder_ps = 0;  ///< the part of it that is not yet a whole nanosecond
  NodeId id;
  bool has_more = true;                 ///< work() may have something to do
  bool is_occupied = false;             ///< an is_free event is pending
  MessageQueue inbox;                   ///< arrived and not received
  std::vector<std::uint32_t> sent;      ///< in the current call, in order
  std::vector<std::uint32_t> outgoing;  ///< sent in a call whose operations are not finished yet
  VirtualTimes times;

  std::uint64_t served_until_ns = 0;  ///< the end of the last interrupt
  std::uint64_t idle_since_ns = 0;
  std::uint64_t service_idle_before_ns = 0;     ///< times.service_idle_ns when it fell idle
  std::uint32_t small_held = 0, bulk_held = 0;  ///< slots of the mailbox that are taken
  MailboxCapacity mailbox;
  std::uint32_t interrupt_kinds;
  core::ZeroedArray<Way> ways;  ///< by target
  std::uint64_t calls = 0;      ///< number of the program's calls, if there is an observer
  Charges charged;              ///< likewise
  Span span, service;           ///< current activity, and the service that interrupted it, likewise
  LocalMemory memory;
  Node node;
};

}  // namespace dmpc::nodes
