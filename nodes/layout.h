// What a part has in a node's local memory, said once: a plan adds it up, and the part's constructor allocates it.
//
// A part says it in a function layout() of what it is made from. A part of parts adds up theirs, which each of them takes itself.
#pragma once

#include <cstddef>
#include <span>
#include <tuple>

#include "nodes/local_memory.h"

namespace dmpc::nodes {

/// For so many objects.
template <class T>
struct Room {
  Category category;
  std::size_t count = 0;

  /// Takes it.
  std::span<T> in(LocalMemory& memory) const { return memory.allocate<T>(category, count); }
  // Implicit: room is added to a plan for what it takes.
  operator MemoryPlan() const {
    MemoryPlan plan;
    plan[category] = LocalMemory::bytes_for<T>(count);
    return plan;
  }
};

/// One room after the other.
template <class... T>
class Layout {
 public:
  constexpr Layout(const Room<T>&... rooms) : rooms_(rooms...) {}

  /// Takes them, in their order.
  std::tuple<std::span<T>...> in(LocalMemory& memory) const {
    return std::apply([&memory](const auto&... room) { return std::tuple<std::span<T>...>{room.in(memory)...}; }, rooms_);
  }
  // Implicit as Room's.
  operator MemoryPlan() const {
    return std::apply([](const auto&... room) { return (MemoryPlan(room) + ...); }, rooms_);
  }

 private:
  std::tuple<Room<T>...> rooms_;
};

}  // namespace dmpc::nodes
