// The awake nodes of a thread that runs several, the order of their turns, and the worker thread's sleep while none is awake.
//
// A node sleeps as any does: its mailbox's word is ASLEEP (nodes/mailbox.h). The thread that replaces that rings its wake-up,
// which puts the node's number into the worker thread's own mailbox; so the worker thread is woken, and counted, like a node with
// its own thread.
//
// Thread safety: wake-ups may be rung by any thread, and woken().rouse() be called; everything else belongs to the worker thread.
//
// Invariants
// (1) A node is in line, or its turn is on, or its mailbox's word is ASLEEP, or it is woken: then its number is with the one
//     thread that has replaced ASLEEP, or in woken(), once. So woken() never has more numbers than there are nodes.
// (2) The awake count (nodes/awake_count.h) counts worker threads. A worker thread leaves it when no node is in line and after
//     the word of woken() has become ASLEEP. A thread that has replaced a node's ASLEEP and not yet rung is a running worker
//     thread, or brings packets, and is counted. So the count is zero only if every node is ASLEEP and nothing is in flight.
// Progress: as push()'s. A worker thread that is stopped between a packet and the wake-up delays the packet's node until it goes
// on, like its own nodes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/expect.h"
#include "nodes/awake_count.h"
#include "nodes/local_memory.h"
#include "nodes/mailbox.h"

namespace dmpc::nodes {

template <class Atomics>
class BasicAwakeNodes {
 public:
  /// `count` nodes, 1 at least, all awake, in line by number. Takes bytes(count) of `memory` (Category::mailbox); `awake`, which
  /// counts the worker thread, outlives this.
  BasicAwakeNodes(std::uint32_t count, LocalMemory& memory, BasicAwakeCount<Atomics>& awake)
      : woken_(capacity(count), memory), awake_(&awake), line_(count), in_line_(count) {
    core::expect(count > 0, "a driver has a node");
    wake_ups_.reserve(count);
    for (std::uint32_t number = 0; number < count; ++number) {
      wake_ups_.emplace_back(*this, number);
      line_[number] = number;
    }
  }
  BasicAwakeNodes(const BasicAwakeNodes&) = delete;
  BasicAwakeNodes& operator=(const BasicAwakeNodes&) = delete;

  /// The memory that the constructor takes, in bytes.
  static std::size_t bytes(std::uint32_t count) { return Mailbox::bytes(capacity(count)); }

  /// For the mailbox of a node.
  WakeUp& wake_up(std::uint32_t number) { return wake_ups_.at(number); }

  /// Puts those that have been woken in line, and calls woke(number) for each.
  template <class Woke>
  void take_woken(const Woke& woke) {
    woken_.drain([&](const Packet& packet) {
      const std::uint32_t number = index_of(packet.source);
      stay(number);
      woke(number);
    });
  }
  /// Removes and returns the node whose turn is next; nothing if none is in line.
  std::optional<std::uint32_t> next() {
    if (in_line_ == 0) {
      return std::nullopt;
    }
    const std::uint32_t number = line_[first_];
    first_ = (first_ + 1) % line_.size();
    --in_line_;
    return number;
  }
  /// Puts a node whose turn is over, and which is awake, at the end of the line.
  void stay(std::uint32_t number) {
    core::expect(in_line_ < line_.size(), "a node is in line once");
    line_[(first_ + in_line_) % line_.size()] = number;
    ++in_line_;
  }

  /// The mailbox before which the worker thread sleeps while no node is in line.
  BasicMailbox<Atomics>& woken() { return woken_; }

 private:
  using Mailbox = BasicMailbox<Atomics>;

  class NodeWakeUp final : public WakeUp {
   public:
    NodeWakeUp(BasicAwakeNodes& nodes, std::uint32_t number) : nodes_(&nodes), number_(number) {}
    void ring() override { nodes_->wake(number_); }

   private:
    BasicAwakeNodes* nodes_;
    std::uint32_t number_;
  };

  static MailboxCapacity capacity(std::uint32_t count) { return {.small_slots = count}; }

  void wake(std::uint32_t number) {
    const PacketHeader header{.bytes = 0, .source = static_cast<std::uint16_t>(number), .kind = 0};
    core::expect(woken_.push(header, {}, *awake_), "a node is woken once until it sleeps again");
  }

  Mailbox woken_;
  BasicAwakeCount<Atomics>* awake_;
  std::vector<NodeWakeUp> wake_ups_;
  std::vector<std::uint32_t> line_;  ///< a ring
  std::size_t first_ = 0, in_line_;
};

using AwakeNodes = BasicAwakeNodes<SystemAtomics>;

}  // namespace dmpc::nodes
