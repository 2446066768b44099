// What a program has to know of its tasks, of whatever type: how long they are, and how they are begun, run and read.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <new>
#include <type_traits>

#include "core/record/records.h"
#include "core/trace/task_state.h"
#include "nodes/charge.h"
#include "nodes/local_memory.h"
#include "svm/pages/pager.h"
#include "svm/pages/task_plan.h"

namespace dmpc::svm {

/// A task: a value without pointers of its own, made again and again. start(number) makes it that one of all; run() reads records
/// by records.find() and answers `more` after a bounded time, `finished`, or `absent` if find() had nothing: then absent() is the
/// address, and run() is called again when it is there, and asks for it again. What it does beside look-ups it adds to the
/// charges. result() is asked for once it is finished.
template <class Task>
concept PagedTask = std::default_initializable<Task> && std::is_trivially_copyable_v<Task> &&
    std::default_initializable<typename Task::Result> && std::is_trivially_copyable_v<typename Task::Result> &&
    requires(Task task, const Task& finished, Pager& records, nodes::Charges& charges, std::uint32_t number) {
  task.start(number);
  { task.run(records, charges) } -> std::same_as<core::TaskState>;
  { finished.absent() } -> std::same_as<core::Address>;
  { finished.result() } -> std::same_as<typename Task::Result>;
};

/// Tasks that lie as bytes in memory aligned to nodes::LocalMemory::alignment, one behind the other. `Records` is Pager or
/// RecordingPager.
template <class Records>
struct TaskKind {
  TaskPlan::Sizes sizes;
  std::function<void(std::byte* task, std::uint32_t number)> start;
  /// Runs a step of a task; where that answers `absent` the address is set.
  std::function<core::TaskState(std::byte* task, Records& records, nodes::Charges& charges, core::Address& absent)> run;
  /// Puts down the result of a finished task.
  std::function<void(const std::byte* task, std::byte* result)> put_result;
};

/// Those of a type.
template <class Records, PagedTask Task>
TaskKind<Records> task_kind() {
  static_assert(alignof(Task) <= nodes::LocalMemory::alignment);
  return {.sizes = {.task_bytes = sizeof(Task), .result_bytes = sizeof(typename Task::Result)},
          .start = [](std::byte* task, std::uint32_t number) { (new (task) Task)->start(number); },
          .run =
              [](std::byte* bytes, Records& records, nodes::Charges& charges, core::Address& absent) {
                Task& task = *std::launder(reinterpret_cast<Task*>(bytes));
                const core::TaskState state = task.run(records, charges);
                absent = state == core::TaskState::absent ? task.absent() : absent;
                return state;
              },
          .put_result =
              [](const std::byte* task, std::byte* result) {
                const typename Task::Result value = std::launder(reinterpret_cast<const Task*>(task))->result();
                std::memcpy(result, &value, sizeof(value));
              }};
}

}  // namespace dmpc::svm
