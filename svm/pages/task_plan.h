// The resources of a run of tasks over pages, known before anything is allocated.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "nodes/computer_request.h"
#include "nodes/layout.h"
#include "nodes/local_memory.h"
#include "nodes/mailbox.h"
#include "svm/pages/page_capacity.h"
#include "svm/pages/replacement.h"

namespace dmpc::svm {

/// Options of tasks. `optional` without a value means: choose.
struct TaskOptions {
  nodes::ComputerRequest computer = {};
  std::size_t page_size_bytes = 1024;                       ///< a power of two, 512 B to 64 KiB
  std::optional<std::uint32_t> cache_pages = std::nullopt;  ///< frames of each node; by default a quarter of the pages
  Replacement replacement = Replacement::lru;               ///< which page is evicted
  std::uint32_t in_flight = 16;                             ///< tasks in flight on a node, 1 to 4096
};

/// Tasks are distributed beforehand, consecutive ones to each node. Immutable; everything is checked when it is made.
class TaskPlan {
 public:
  /// Sizes of a task.
  struct Sizes {
    std::size_t task_bytes = 0;    ///< per task in flight
    std::size_t result_bytes = 0;  ///< per result, in flight or done
  };

  /// Plans `task_count` tasks over `database_bytes`, both above 0. Throws core::Refusal<core::UsageError> for values out of range
  /// and bytes that are not whole pages, of core::CapacityError for less memory than a node needs, naming that.
  TaskPlan(const TaskOptions& options, std::size_t database_bytes, std::uint32_t task_count, const Sizes& sizes);

  const nodes::ComputerRequest& computer() const { return options_.computer; }
  std::uint32_t node_count() const { return options_.computer.node_count; }
  /// The first task of a node; for node_count the number of all tasks.
  std::uint32_t first_task(std::uint32_t node) const {
    return static_cast<std::uint32_t>(std::uint64_t{task_count_} * node / node_count());
  }
  std::uint32_t tasks_at(std::uint32_t node) const { return first_task(node + 1) - first_task(node); }
  std::uint32_t in_flight() const { return in_flight_; }
  const PageCapacity& pages() const { return pages_; }
  const nodes::MailboxCapacity& mailbox() const { return mailbox_; }
  std::size_t held_bytes() const { return held_bytes_; }

  /// A node's program's memory without its pages: tasks; their numbers, runnable ones, free slots; results.
  nodes::Layout<std::byte, std::uint32_t, std::uint32_t, std::uint32_t, std::byte> program_layout(std::uint32_t node) const;
  /// The exact memory of a node.
  nodes::MemoryPlan node_memory(std::uint32_t node) const;
  /// The memory of the host, which has nothing to do.
  nodes::MemoryPlan host_memory() const;

 private:
  nodes::MemoryPlan memory_beside_program(const nodes::MailboxCapacity& mailbox) const;
  void check() const;
  void check_memory() const;

  TaskOptions options_;
  std::uint32_t task_count_;
  Sizes sizes_;
  std::uint32_t in_flight_ = 1;
  PageCapacity pages_;
  nodes::MailboxCapacity mailbox_;
  std::size_t held_bytes_ = 0;
};

}  // namespace dmpc::svm
