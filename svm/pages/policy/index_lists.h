// Numbers in lists, the newest in front.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/base/expect.h"
#include "core/picture/memory_use.h"
#include "nodes/layout.h"
#include "nodes/local_memory.h"

namespace dmpc::svm {

/// Two doubly linked lists of the numbers below a count, each in one of them or in neither. In the node's local memory. Not
/// thread-safe.
class IndexLists {
  struct Link;

 public:
  IndexLists(nodes::LocalMemory& memory, std::uint32_t count) : links_(layout(count).in(memory)) {}
  /// The memory that the constructor takes.
  static nodes::Room<Link> layout(std::uint32_t count) { return {core::MemoryUse::page_table, count}; }

  /// Requires that `index` is in neither list.
  void push(unsigned list, std::uint32_t index) {
    core::expect(links_[index].list == 0, "a number is in one list at most");
    Ends& ends = ends_[list];
    links_[index] = {.older = ends.newest, .newer = none, .list = list + 1};
    (ends.newest == none ? ends.oldest : links_[ends.newest].newer) = index;
    ends.newest = index;
    ++ends.size;
  }
  /// Takes `index` out of the list that it is in.
  void remove(std::uint32_t index) {
    const Link link = links_[index];
    core::expect(link.list != 0, "what is removed is in a list");
    Ends& ends = ends_[link.list - 1];
    (link.older == none ? ends.oldest : links_[link.older].newer) = link.newer;
    (link.newer == none ? ends.newest : links_[link.newer].older) = link.older;
    links_[index] = {};
    --ends.size;
  }
  /// Removes the oldest of the list, which must not be empty.
  std::uint32_t remove_oldest(unsigned list) {
    const std::uint32_t oldest = ends_[list].oldest;
    core::expect(oldest != none, "there is an oldest of some");
    remove(oldest);
    return oldest;
  }

  std::uint32_t size(unsigned list) const { return ends_[list].size; }
  /// The list of `index`, which must be in one.
  unsigned list_of(std::uint32_t index) const { return links_[index].list - 1; }

 private:
  static constexpr std::uint32_t none = 0xffffffffU;

  struct Link {
    std::uint32_t older = none, newer = none;
    std::uint32_t list = 0;  ///< one more than the list's number; 0: in neither
  };
  struct Ends {
    std::uint32_t oldest = none, newest = none;
    std::uint32_t size = 0;
  };

  std::span<Link> links_;
  std::array<Ends, 2> ends_;
};

}  // namespace dmpc::svm
