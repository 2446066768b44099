// A program's interface to its tasks, of any type: their sizes, and how they are begun, run and read.
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

/// A task: a value without pointers, which is reused. start(number) makes it task `number`; run() reads records by records.find()
/// and returns `more` after a bounded time, `finished`, or `absent` if find() had nothing: then absent() is the address, and
/// run() is called again when it is present, and reads it again. It adds its work apart from look-ups to the charges. result() is
/// called once it is finished.
template <class Task>
concept PagedTask = std::default_initializable<Task> && std::is_trivially_copyable_v<Task> &&
    std::default_initializable<typename Task::Result> && std::is_trivially_copyable_v<typename Task::Result> &&
    requires(Task task, const Task& finished, Pager& records, nodes::Charges& charges, std::uint32_t number) {
  task.start(number);
  { task.run(records, charges) } -> std::same_as<core::TaskState>;
  { finished.absent() } -> std::same_as<core::Address>;
  { finished.result() } -> std::same_as<typename Task::Result>;
};

/// Tasks as bytes in memory aligned to nodes::LocalMemory::alignment, one after the other. `Records` is Pager or RecordingPager.
template <class Records>
struct TaskKind {
  TaskPlan::Sizes sizes;
  std::function<void(std::byte* task, std::uint32_t number)> start;
  /// Runs a step of a task; if that returns `absent` the address is set.
  std::function<core::TaskState(std::byte* task, Records& records, nodes::Charges& charges, core::Address& absent)> run;
  /// Stores the result of a finished task.
  std::function<void(const std::byte* task, std::byte* result)> put_result;
};

/// The TaskKind of a type.
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
