// Which node keeps a page for good: by arithmetic, so that no node needs a table of all pages.
#pragma once

#include <cstdint>

#include "core/base/expect.h"
#include "svm/page.h"

namespace dmpc::svm {

/// Page p lives at node p mod N, as the (p div N)-th of its home pages: spread evenly, without any strategy, as in the 1994
/// paper. The division is a multiplication by ceil(2^63 / N), exact for every 32-bit page and N < 2^16: the quotient's error
/// p * e / (N * 2^63), with e < N, stays below 1 / N (T. Granlund, P. Montgomery, "Division by Invariant Integers using
/// Multiplication", 1994).
class Homes {
 public:
  struct Place {
    std::uint32_t node = 0;
    std::uint32_t slot = 0;
    constexpr bool operator==(const Place&) const = default;
  };

  /// Requires 1 <= node_count < 2^16.
  explicit Homes(std::uint32_t node_count)
      : node_count_(node_count), reciprocal_(node_count == 0 ? 0 : ((std::uint64_t{1} << 63U) + node_count - 1) / node_count) {
    core::expect(node_count >= 1 && node_count < node_count_limit, "a machine has from 1 to 65535 nodes");
  }

  Place place_of(PageId page) const {
    const auto slot = static_cast<std::uint32_t>((Wide{reciprocal_} * index_of(page)) >> 63U);
    return {index_of(page) - slot * node_count_, slot};
  }
  PageId page_at(Place place) const { return PageId{place.slot * node_count_ + place.node}; }
  /// How many of `page_count` pages are at home at `node`.
  std::uint32_t count_at(std::uint32_t node, std::uint32_t page_count) const {
    return page_count / node_count_ + (node < page_count % node_count_ ? 1 : 0);
  }

 private:
  __extension__ using Wide = unsigned __int128;
  static constexpr std::uint32_t node_count_limit = 65536;

  std::uint32_t node_count_;
  std::uint64_t reciprocal_;
};

}  // namespace dmpc::svm
