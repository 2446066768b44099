// A tree of nodes below the host for page requests, if all pages are at home there.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "core/base/expect.h"
#include "svm/pages/home.h"

namespace dmpc::svm {

/// A transputer has four links: one up, three down.
inline constexpr std::uint32_t tree_arity = 3;

/// The host is the root, and it and every node have up to `arity` children, in the order of the nodes' numbers. With an arity of
/// node_count or more all nodes are the host's children: a star. Requests go from child to parent, so there can be no circular
/// wait, and the host has every page.
class RequestTree {
 public:
  /// Requires both to be 1 or more.
  RequestTree(std::uint32_t node_count, std::uint32_t arity) : node_count_(node_count), arity_(arity) {
    core::expect(node_count >= 1 && arity >= 1, "a tree has a node, and a parent a child");
  }

  std::uint32_t host() const { return node_count_; }
  /// Whom a node asks: a node with a lower number, or the host.
  std::uint32_t parent_of(std::uint32_t node) const { return node < arity_ ? host() : node / arity_ - 1; }
  /// The number of nodes whose requests may come to this one: all below it.
  std::uint32_t count_below(std::uint32_t node) const {
    std::uint64_t first = node, last = node, count = 0;
    while ((first + 1) * arity_ < node_count_) {
      first = (first + 1) * arity_;
      last = (last + 2) * arity_ - 1;
      count += std::min<std::uint64_t>(last, node_count_ - 1) - first + 1;
    }
    return static_cast<std::uint32_t>(count);
  }
  /// Whether requests of `node` may come to `upper`, a node or the host.
  bool is_above(std::uint32_t upper, std::uint32_t node) const {
    std::uint32_t at = parent_of(node);
    while (at > upper && at != host()) {
      at = parent_of(at);
    }
    return at == upper || upper == host();
  }

 private:
  std::uint32_t node_count_, arity_;
};

/// The tree of a computer with `node_count` nodes; nothing if nodes ask each other, or if all ask the host directly.
inline std::optional<RequestTree> request_tree_of(PageHomes where, std::uint32_t node_count) {
  return are_at_host(where) ? std::optional(RequestTree(node_count, where == PageHomes::tree ? tree_arity : node_count))
                            : std::nullopt;
}

}  // namespace dmpc::svm
