// Plans mailboxes, credits and memory of every node from a program's declarations.
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

/// The memory categories of a program, besides those of the computer.
enum class ProgramMemory : std::uint8_t { declared };

/// A computer for a program. Immutable; everything is checked at construction.
class ProgramPlan {
 public:
  /// Throws core::UsageError for needs that contradict each other or exceed the computer's limits, naming them, and
  /// core::CapacityError if they exceed `computer.node_memory_bytes`, naming a sufficient size.
  ProgramPlan(Needs needs, const nodes::ComputerRequest& computer);

  const Needs& needs() const { return needs_; }
  std::uint32_t node_count() const { return node_count_; }
  /// Returns the answer to `packet`, or the request that `packet` answers.
  std::optional<Index> answer_of(Index packet) const { return answers_[packet]; }
  std::optional<Index> request_of(Index packet) const { return requests_[packet]; }
  bool is_small(Index packet) const { return needs_.packets[packet].bytes_max <= small_bytes_max; }
  /// Returns how many packets `source` may have in flight to `target`; under chaos fewer than there are slots for.
  std::uint32_t credits(std::uint32_t source, std::uint32_t target, Index packet) const;

  /// Returns the maximum payload over all packets.
  std::size_t payload_bytes_max() const;
  /// Equal plans have equal digests.
  std::uint64_t digest() const;

  const nodes::MailboxCapacity& mailbox(std::uint32_t node) const { return mailboxes_[node]; }
  /// Returns the memory plan of a node, including its program.
  nodes::MemoryPlan memory(std::uint32_t node) const;
  /// Returns the memory plan of the host, which has no work.
  nodes::MemoryPlan host_memory() const;
  std::size_t held_bytes() const { return held_bytes_; }
  /// The program's table of credits and unanswered packets, by packet and node.
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
