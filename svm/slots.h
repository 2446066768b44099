// The tasks of pixels in flight on a node: a bounded number, free, runnable or waiting for a page.
#pragma once

#include <cstdint>
#include <span>

#include "core/base/expect.h"
#include "core/picture/memory_use.h"
#include "core/picture/shade.h"
#include "nodes/layout.h"
#include "nodes/local_memory.h"

namespace dmpc::svm {

/// `count` tasks, each with a ray stack of `waiting_max` entries. A slot is free, or active; an active one is runnable, or held
/// by its user (the pager, when it waits). Not thread-safe.
template <class Task>
class Slots {
  using Hits = typename Task::Hits;
  struct Slot;

 public:
  Slots(nodes::LocalMemory& memory, std::uint32_t count, std::uint32_t waiting_max) {
    std::span<Hits> stacks;
    std::tie(tasks_, runnable_, free_, stacks) = layout(count, waiting_max).in(memory);
    for (std::uint32_t slot = 0; slot < count; ++slot) {
      tasks_[slot].task = Task(stacks.subspan(std::size_t{slot} * waiting_max, waiting_max));
      free_[free_count_++] = count - 1 - slot;
    }
  }
  /// The memory that the constructor takes.
  static nodes::Layout<Slot, std::uint32_t, std::uint32_t, Hits> layout(std::uint32_t count, std::uint32_t waiting_max) {
    return {{core::MemoryUse::ray_stacks, count},
            {nodes::Category::queues, count},
            {nodes::Category::queues, count},
            {core::MemoryUse::ray_stacks, std::size_t{count} * waiting_max}};
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
  /// A task whose stack is set after local memory has made it.
  struct Slot {
    Task task{std::span<Hits>{}};
  };

  std::span<Slot> tasks_;
  std::span<std::uint32_t> runnable_, free_;
  std::uint32_t runnable_count_ = 0, free_count_ = 0;
};

}  // namespace dmpc::svm
