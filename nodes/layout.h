// A part's share of a node's local memory, defined once: a plan adds it up, and the part's constructor allocates it.
//
// A part defines it in a function layout() of its constructor's arguments. A compound part adds up the layouts of its parts,
// which allocate themselves.
#pragma once

#include <cstddef>
#include <span>
#include <tuple>

#include "nodes/local_memory.h"

namespace dmpc::nodes {

/// Memory for `count` objects.
template <class T>
struct Room {
  Category category;
  std::size_t count = 0;

  /// Allocates it.
  std::span<T> in(LocalMemory& memory) const { return memory.allocate<T>(category, count); }
  // Implicit, so that it can be added to a plan.
  operator MemoryPlan() const {
    MemoryPlan plan;
    plan[category] = LocalMemory::bytes_for<T>(count);
    return plan;
  }
};

/// Several arrays, one after the other.
template <class... T>
class Layout {
 public:
  constexpr Layout(const Room<T>&... rooms) : rooms_(rooms...) {}

  /// Allocates them in order.
  std::tuple<std::span<T>...> in(LocalMemory& memory) const {
    return std::apply([&memory](const auto&... room) { return std::tuple<std::span<T>...>{room.in(memory)...}; }, rooms_);
  }
  // Implicit like Room's.
  operator MemoryPlan() const {
    return std::apply([](const auto&... room) { return (MemoryPlan(room) + ...); }, rooms_);
  }

 private:
  std::tuple<Room<T>...> rooms_;
};

}  // namespace dmpc::nodes
