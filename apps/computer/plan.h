// From what a program declares to what every node gets: mailboxes, credits, memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "apps/computer/dmpc/computer.h"
#include "nodes/computer_request.h"
#include "nodes/layout.h"
#include "nodes/local_memory.h"
#include "nodes/mailbox.h"

namespace dmpc::apps {

/// What a program's nodes spend memory on, beside what the computer takes.
enum class ProgramMemory : std::uint8_t { declared };

/// A computer for a program. Immutable; everything is checked when it is made.
class ProgramPlan {
 public:
  /// Throws core::UsageError for needs that contradict each other or go beyond the computer's bounds, naming them, and
  /// core::CapacityError for more than `computer.node_memory_bytes`, naming what would do.
  ProgramPlan(Needs needs, const nodes::ComputerRequest& computer);

  const Needs& needs() const { return needs_; }
  std::uint32_t node_count() const { return node_count_; }
  /// The packet that answers `packet`, or that `packet` answers.
  std::optional<Index> answer_of(Index packet) const { return answers_[packet]; }
  std::optional<Index> request_of(Index packet) const { return requests_[packet]; }
  bool is_small(Index packet) const { return needs_.packets[packet].bytes_max <= small_bytes_max; }
  /// How many of them `source` may have under way to `target`; fewer than there are slots for under chaos.
  std::uint32_t credits(std::uint32_t source, std::uint32_t target, Index packet) const;

  /// The longest payload of all packets.
  std::size_t payload_bytes_max() const;
  /// Equal plans, equal digests.
  std::uint64_t digest() const;

  const nodes::MailboxCapacity& mailbox(std::uint32_t node) const { return mailboxes_[node]; }
  /// The memory of a node, all of its program's included.
  nodes::MemoryPlan memory(std::uint32_t node) const;
  /// The memory of the host, which has nothing to do.
  nodes::MemoryPlan host_memory() const;
  std::size_t held_bytes() const { return held_bytes_; }
  /// The table of credits and unanswered packets of a program's own, by packet and node.
  nodes::Room<std::uint16_t> rights() const { return {nodes::Category::queues, needs_.packets.size() * node_count_}; }

 private:
  void check_names() const;
  void check_sizes() const;
  void match_answers();
  void count_places();
  std::uint32_t places(std::uint32_t source, std::uint32_t target, Index packet) const;
  nodes::MemoryPlan memory_beside_program(const nodes::MailboxCapacity& mailbox) const;
  void check_memory(const nodes::ComputerRequest& computer) const;

  Needs needs_;
  std::uint32_t node_count_;
  std::optional<nodes::Chaos> chaos_;
  std::size_t stack_bytes_;
  std::size_t held_bytes_ = 0;
  std::vector<std::optional<Index>> answers_, requests_;  ///< by packet
  std::vector<nodes::MailboxCapacity> mailboxes_;         ///< by node
};

}  // namespace dmpc::apps
