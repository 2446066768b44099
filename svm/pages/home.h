// The home of a page, a node or the host: by arithmetic, so that no node needs a table of all pages.
#pragma once

#include <cstdint>

#include "core/base/expect.h"
#include "svm/pages/page.h"

namespace dmpc::svm {

/// Where pages are at home.
enum class PageHomes : std::uint8_t {
  spread,  ///< distributed over the nodes
  host,    ///< all at the host, which every node asks, like the virtual memory of the Pixel Machine
  tree     ///< all at the host, which is the root of a tree of nodes that ask their parents (svm/pages/request_tree.h)
};
/// As the command line calls it.
constexpr const char* name_of(PageHomes homes) {
  return homes == PageHomes::spread ? "spread" : homes == PageHomes::host ? "host" : "tree";
}
/// The host has all pages, and no node has any permanently.
constexpr bool are_at_host(PageHomes homes) { return homes != PageHomes::spread; }

/// Page p lives at node p mod N, as the (p div N)-th of its home pages: distributed evenly, without any heuristics, as in the
/// article. Or all of them live at the host, whose index is node_count. The division is a multiplication by ceil(2^63 / N), exact
/// for every 32-bit page and N < 2^16: the quotient's error p * e / (N * 2^63), with e < N, stays below 1 / N (T. Granlund, P.
/// Montgomery, "Division by Invariant Integers using Multiplication", 1994).
class Homes {
 public:
  struct Place {
    std::uint32_t node = 0;
    std::uint32_t slot = 0;
    constexpr bool operator==(const Place&) const = default;
  };

  /// The homes of pages distributed over `node_count` nodes from `first` on. Requires 1 <= node_count < 2^16.
  explicit Homes(std::uint32_t node_count, std::uint32_t first = 0)
      : node_count_(node_count),
        first_(first),
        reciprocal_(node_count == 0 ? 0 : ((std::uint64_t{1} << 63U) + node_count - 1) / node_count) {
    core::expect(node_count >= 1 && node_count < node_count_limit, "a machine has from 1 to 65535 nodes");
  }

  Place place_of(PageId page) const {
    const auto slot = static_cast<std::uint32_t>((Wide{reciprocal_} * index_of(page)) >> 63U);
    return {first_ + index_of(page) - slot * node_count_, slot};
  }
  PageId page_at(Place place) const { return PageId{place.slot * node_count_ + place.node - first_}; }
  /// The number of pages, of `page_count`, that are at home at `node`, or at the host.
  std::uint32_t count_at(std::uint32_t node, std::uint32_t page_count) const {
    if (node < first_ || node >= end()) {
      return 0;
    }
    return page_count / node_count_ + (node - first_ < page_count % node_count_ ? 1 : 0);
  }
  /// The first node that is a home; end() is one past the last.
  std::uint32_t first() const { return first_; }
  std::uint32_t end() const { return first_ + node_count_; }

 private:
  __extension__ using Wide = unsigned __int128;
  static constexpr std::uint32_t node_count_limit = 65536;

  std::uint32_t node_count_;
  std::uint32_t first_;
  std::uint64_t reciprocal_;
};

/// The homes on a computer with `node_count` nodes.
inline Homes homes_of(PageHomes where, std::uint32_t node_count) {
  return are_at_host(where) ? Homes(1, node_count) : Homes(node_count);
}

}  // namespace dmpc::svm
