// Tasks over pages, for the emulated computer: data too large for one node are distributed over all nodes in pages, and tasks
// read them from any node. This header and <dmpc/computer.h> are the whole interface.
//
// A task never blocks: if a page is not at its node, it returns `absent`, other tasks run, and it is called again when the page
// has arrived.
#pragma once

#include <dmpc/computer.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <new>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace dmpc {

/// The maximum number of operations that a program of tasks declares; page look-ups have their own prices.
inline constexpr std::size_t task_operations_max = 8;
/// The alignment of offsets for Pages::find().
inline constexpr std::size_t find_alignment = 8;

/// The result of a bounded step of a task.
enum class Step : std::uint8_t {
  finished,
  more,   ///< call again
  absent  ///< the last page looked up is not here: call again when it is
};

/// A task's view of the data while it runs.
class Pages {
 public:
  /// Returns the bytes from `offset`, a multiple of find_alignment, to the end of its page until the next call; nullptr if
  /// absent.
  virtual const std::byte* find(std::uint64_t offset) = 0;
  /// Reads the value at `offset`; returns false if its page is absent. Values are aligned to their size, so none crosses pages.
  template <class T>
  [[nodiscard]] bool read(std::uint64_t offset, T& value) {
    static_assert(std::is_trivially_copyable_v<T> && sizeof(T) <= 512 && (sizeof(T) & (sizeof(T) - 1)) == 0);
    const std::byte* const place = find(offset / find_alignment * find_alignment);
    if (place != nullptr) {
      std::memcpy(&value, place + offset % find_alignment, sizeof(T));
    }
    return place != nullptr;
  }
  /// Counts `count` operations, which take time on a modelled machine. Look-ups are counted automatically.
  virtual void charge(Index operation, std::uint64_t count = 1) = 0;

 protected:
  ~Pages() = default;
};

/// A type-erased kind of task: bytes in a node's memory.
struct AnyTask {
  std::size_t task_bytes = 0, result_bytes = 0;
  std::function<void(std::byte* task, std::uint32_t number)> make;
  std::function<Step(std::byte* task, Pages& pages)> run;
  std::function<void(const std::byte* task, std::byte* result)> put_result;
};

/// The computer that the command line requests.
class PagedComputer {
 public:
  virtual std::uint32_t node_count() const = 0;
  virtual std::size_t page_bytes() const = 0;

  /// Runs tasks 0 .. count - 1 over `data`. Every node gets its share of the pages and a contiguous range of the tasks.
  /// make(number) makes a task, a value without pointers that has
  ///
  ///   dmpc::Step run(dmpc::Pages& pages);   // one bounded step
  ///   Result result() const;                // asked for once, when it is finished
  ///
  /// Nodes call make() concurrently. Returns the results in order. They are identical on every computer if they
  /// depend only on the number and the data. Caches are empty at the start of a run.
  template <class T, class Make>
  auto run(std::span<const T> data, std::uint32_t count, const Make& make);

 protected:
  ~PagedComputer() = default;

 private:
  /// `has_unique_bytes`: equal values have equal bytes, without padding between them.
  virtual void run_any(std::span<const std::byte> data, bool has_unique_bytes, std::uint32_t count, const AnyTask& task,
                       std::byte* results) = 0;
};

/// A program of tasks and its user interface.
struct PagedApplication {
  std::string description;  ///< one sentence on what it does
  std::vector<NumberOption> options = {};
  std::vector<OperationNeed> operations = {};
  /// Does the program's work after the options are read: one or more runs of tasks. Returns the result in one or more lines.
  /// Throws UsageError for contradictory options.
  std::function<std::string(PagedComputer&)> act;
};

/// Reads the command line (nodes, runner, machine, chaos, pages, caches, counters, references, heat, trace, report, and the
/// program's own options), calls `act`, prints the result, and returns the exit status as dmpc::run() does. Call it once, from
/// main().
int run_tasks(int count, const char* const* words, const PagedApplication& application);

template <class T, class Make>
auto PagedComputer::run(std::span<const T> data, std::uint32_t count, const Make& make) {
  using Task = std::invoke_result_t<const Make&, std::uint32_t>;
  using Result = decltype(std::declval<const Task&>().result());
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_copyable_v<Task> && std::is_trivially_copyable_v<Result>);
  static_assert(alignof(Task) <= 64, "where a node keeps tasks");
  std::vector<Result> results(count);
  const AnyTask task = {
      .task_bytes = sizeof(Task),
      .result_bytes = sizeof(Result),
      .make = [&make](std::byte* place, std::uint32_t number) { new (place) Task(make(number)); },
      .run = [](std::byte* place, Pages& pages) { return std::launder(reinterpret_cast<Task*>(place))->run(pages); },
      .put_result =
          [](const std::byte* place, std::byte* result) {
            const Result value = std::launder(reinterpret_cast<const Task*>(place))->result();
            std::memcpy(result, &value, sizeof(value));
          }};
  constexpr bool has_unique_bytes = std::has_unique_object_representations_v<T> || std::is_floating_point_v<T>;
  run_any(std::as_bytes(data), has_unique_bytes, count, task, reinterpret_cast<std::byte*>(results.data()));
  return results;
}

}  // namespace dmpc
