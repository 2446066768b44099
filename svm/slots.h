// The tasks of pixels in flight on a node: a bounded number, free, runnable or waiting for a page.
#pragma once

#include <cstdint>
#include <span>

#include "core/base/expect.h"
#include "core/picture/memory_use.h"
#include "core/picture/shade.h"
#include "nodes/local_memory.h"

namespace dmpc::svm {

/// `count` tasks, each with a ray stack of `depth_max` entries. A slot is free, or active; an active one is runnable, or known
/// to whoever took it (the pager, when it waits). Thread safety: none.
template <class Task>
class Slots {
  using Hits = typename Task::Hits;

 public:
  Slots(nodes::LocalMemory& memory, std::uint32_t count, std::uint32_t depth_max)
      : tasks_(memory.allocate<Slot>(core::MemoryUse::ray_stacks, count)),
        runnable_(memory.allocate<std::uint32_t>(nodes::Category::queues, count)),
        free_(memory.allocate<std::uint32_t>(nodes::Category::queues, count)) {
    const std::span<Hits> stacks = memory.allocate<Hits>(core::MemoryUse::ray_stacks, std::size_t{count} * depth_max);
    for (std::uint32_t slot = 0; slot < count; ++slot) {
      tasks_[slot].task = Task(stacks.subspan(std::size_t{slot} * depth_max, depth_max));
      free_[free_count_++] = count - 1 - slot;
    }
  }
  /// Adds to `plan` exactly what the constructor takes.
  static void add_needs(nodes::MemoryPlan& plan, std::uint32_t count, std::uint32_t depth_max) {
    using nodes::Category;
    using nodes::LocalMemory;
    plan[core::MemoryUse::ray_stacks] += LocalMemory::bytes_for<Slot>(count);
    plan[core::MemoryUse::ray_stacks] += LocalMemory::bytes_for<Hits>(std::size_t{count} * depth_max);
    plan[Category::queues] += 2 * LocalMemory::bytes_for<std::uint32_t>(count);
  }

  Task& task(std::uint32_t slot) { return tasks_[slot].task; }
  std::uint32_t active() const { return static_cast<std::uint32_t>(tasks_.size()) - free_count_; }
  bool has_free() const { return free_count_ > 0; }
  bool has_runnable() const { return runnable_count_ > 0; }

  /// Requires has_free().
  std::uint32_t take_free() {
    core::expect(has_free(), "a pixel starts in a free slot");
    return free_[--free_count_];
  }
  void make_free(std::uint32_t slot) {
    core::expect(free_count_ < free_.size(), "a slot is given back once");
    free_[free_count_++] = slot;
  }
  /// The slot that was made runnable last. Requires has_runnable().
  std::uint32_t take_runnable() {
    core::expect(has_runnable(), "only a runnable slot runs");
    return runnable_[--runnable_count_];
  }
  void make_runnable(std::uint32_t slot) {
    core::expect(runnable_count_ < runnable_.size(), "a slot is runnable once");
    runnable_[runnable_count_++] = slot;
  }

 private:
  /// A task that local memory can make before its stack is known.
  struct Slot {
    Task task{std::span<Hits>{}};
  };

  std::span<Slot> tasks_;
  std::span<std::uint32_t> runnable_, free_;
  std::uint32_t runnable_count_ = 0, free_count_ = 0;
};

}  // namespace dmpc::svm
