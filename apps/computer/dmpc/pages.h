// Tasks over pages, for the emulated computer: data that fit no node are spread over all of them in pages, and tasks read them
// from wherever they run. The whole interface, beside the words of <dmpc/computer.h>.
//
// A task never waits: where its page is not at its node, it says so, others go on, and it is called again when the page has come.
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

/// The most operations that a program of tasks declares: look-ups of pages have prices of their own.
inline constexpr std::size_t task_operations_max = 8;
/// What a place in the data is a multiple of, for Pages::find().
inline constexpr std::size_t find_alignment = 8;

/// What came of a bounded step of a task.
enum class Step : std::uint8_t {
  finished,
  more,   ///< to be called again
  absent  ///< the last page that it looked up is not here: to be called again when it is
};

/// The data as a task sees them while it runs.
class Pages {
 public:
  /// The byte at `offset`, a multiple of find_alignment, and those behind it to the end of its page; nullptr if that is not
  /// here. Until the next call.
  virtual const std::byte* find(std::uint64_t offset) = 0;
  /// Whether the page of `offset` is here: then the value that lies there is put into `value`. Values lie at multiples of their
  /// size, so that none lies in two pages.
  template <class T>
  [[nodiscard]] bool read(std::uint64_t offset, T& value) {
    static_assert(std::is_trivially_copyable_v<T> && sizeof(T) <= 512 && (sizeof(T) & (sizeof(T) - 1)) == 0);
    const std::byte* const place = find(offset / find_alignment * find_alignment);
    if (place != nullptr) {
      std::memcpy(&value, place + offset % find_alignment, sizeof(T));
    }
    return place != nullptr;
  }
  /// Counts `count` operations, which take time on a modelled machine. Look-ups are counted without it.
  virtual void charge(Index operation, std::uint64_t count = 1) = 0;

 protected:
  ~Pages() = default;
};

/// A kind of task with its type erased: bytes in a node's memory.
struct AnyTask {
  std::size_t task_bytes = 0, result_bytes = 0;
  std::function<void(std::byte* task, std::uint32_t number)> make;
  std::function<Step(std::byte* task, Pages& pages)> run;
  std::function<void(const std::byte* task, std::byte* result)> put_result;
};

/// The computer that the command line asks for.
class PagedComputer {
 public:
  virtual std::uint32_t node_count() const = 0;
  virtual std::size_t page_bytes() const = 0;

  /// Runs tasks 0 .. count - 1 over `data`, of which every node gets its share of the pages, and each its part of the tasks in a
  /// row. make(number) makes a task, a value without pointers of its own, which has
  ///
  ///   dmpc::Step run(dmpc::Pages& pages);   // one bounded step
  ///   Result result() const;                // asked for once, when it is finished
  ///
  /// Nodes call it at the same time. Returns the results in order: the same on every computer, if they depend on the number and
  /// the data alone. Caches are empty when a run begins.
  template <class T, class Make>
  auto run(std::span<const T> data, std::uint32_t count, const Make& make);

 protected:
  ~PagedComputer() = default;

 private:
  /// `has_unique_bytes`: equal values have equal bytes, without padding between them.
  virtual void run_any(std::span<const std::byte> data, bool has_unique_bytes, std::uint32_t count, const AnyTask& task,
                       std::byte* results) = 0;
};

/// A program of tasks as its user meets it.
struct PagedApplication {
  std::string description;  ///< what it does, a sentence
  std::vector<NumberOption> options = {};
  std::vector<OperationNeed> operations = {};
  /// All that it does, once the options are read: runs of tasks, one or several. Returns what they came to, a line or several.
  /// Throws UsageError for options that do not go together.
  std::function<std::string(PagedComputer&)> act;
};

/// Reads the command line (nodes, runner, machine, chaos, pages, caches, counters, references, heat, trace, report, and the
/// program's own options), acts, prints what came of it, and returns the exit status as dmpc::run() does. Call it once, from
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
