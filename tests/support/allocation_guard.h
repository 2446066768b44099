// Counts what threads under watch allocate by operator new, in the executable whose global operators count
// (tests/nodes/allocation/allocation_guard_test.cpp).
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <memory>
#include <new>
#include <string>
#include <utility>

#include "core/base/units.h"
#include "nodes/program.h"
#include "nodes/threads/threads_runner.h"

namespace dmpc::tests {

/// What the threads under watch did so far, all together.
struct Allocations {
  std::uint64_t allocated = 0;
  std::uint64_t freed = 0;
};

namespace allocation_guard {

inline thread_local bool is_watched = false;
inline std::atomic<std::uint64_t> allocated{0};
inline std::atomic<std::uint64_t> freed{0};

inline void* try_allocate(std::size_t bytes, std::size_t alignment) {
  if (is_watched) {
    allocated.fetch_add(1, std::memory_order_relaxed);
  }
  const std::size_t some_bytes = bytes == 0 ? 1 : bytes;
  return std::aligned_alloc(alignment, core::round_up(some_bytes, alignment));
}

inline void* allocate(std::size_t bytes, std::size_t alignment) {
  void* const place = try_allocate(bytes, alignment);
  if (place == nullptr) {
    throw std::bad_alloc();
  }
  return place;
}

inline void release(void* place) {
  if (is_watched && place != nullptr) {
    freed.fetch_add(1, std::memory_order_relaxed);
  }
  std::free(place);
}

}  // namespace allocation_guard

/// The sum of all threads under watch since the program began. Read it while none of them runs.
inline Allocations watched_allocations() { return {allocation_guard::allocated.load(), allocation_guard::freed.load()}; }

/// What threads under watch allocate and free in a run, in times.
inline std::uint64_t allocated_in_run(nodes::Runner& runner) {
  const Allocations before = watched_allocations();
  static_cast<void>(runner.run({}));
  const Allocations after = watched_allocations();
  return after.allocated - before.allocated + after.freed - before.freed;
}

/// A program as it is, on a thread that is under watch from its first call to its end (the runner's own code included).
class WatchedProgram final : public nodes::Program {
 public:
  explicit WatchedProgram(std::unique_ptr<nodes::Program> program) : program_(std::move(program)) {}

  void receive(const nodes::Packet& packet) override {
    allocation_guard::is_watched = true;
    program_->receive(packet);
  }
  bool work() override {
    allocation_guard::is_watched = true;
    return program_->work();
  }
  bool has_leftovers() const override { return program_->has_leftovers(); }
  bool finished() const override { return program_->finished(); }
  std::string describe() const override { return program_->describe(); }

 private:
  std::unique_ptr<nodes::Program> program_;
};

/// This node, its program under watch.
inline nodes::NodeSpecification watched(nodes::NodeSpecification specification) {
  specification.make_program = [make_program = std::move(specification.make_program)](nodes::Node& node) {
    return std::make_unique<WatchedProgram>(make_program(node));
  };
  return specification;
}

}  // namespace dmpc::tests
