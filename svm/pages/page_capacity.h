// The number of pages, and a node's capacities for pages and pixels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "svm/pages/cache.h"
#include "svm/pages/home.h"
#include "svm/pages/request_tree.h"

namespace dmpc::svm {

/// The maximum number of pixels, or other tasks, in flight on a node.
inline constexpr std::uint32_t in_flight_max = 4096;

/// The size of a node's part of the database; the same on all nodes.
struct PageCapacity {
  std::uint32_t page_count = 0;  ///< in the database
  std::uint32_t node_count = 1;
  PageHomes where = PageHomes::spread;    ///< where they are at home
  std::uint32_t resident_count = 0;       ///< pages that every node keeps permanently, wherever they are at home
  std::span<const PageId> resident = {};  ///< which; as many, once they are known, and they outlive the making of programs
  CacheShape cache;                       ///< with frames of the page size
  std::uint32_t in_flight = 1;            ///< pixels, or other tasks, in flight
  std::uint32_t rays_a_task = 1;          ///< at most, under way at once
  std::uint32_t faults_max = 0;           ///< maximum in flight
  std::uint32_t request_credits = 0;      ///< page requests, or other packets that ask, that may be in flight to one home
  std::uint32_t leading_pages = 0;        ///< the first ones, if every node holds them: they have no home
  std::uint32_t open_pages = 0;           ///< the last of these, or those after them, that lead into pages elsewhere

  std::size_t page_size_bytes() const { return cache.page_size_bytes; }
  std::size_t database_bytes() const { return page_count * page_size_bytes(); }
  std::size_t leading_bytes() const { return leading_pages * page_size_bytes(); }
  Homes homes() const { return homes_of(where, node_count); }
  /// The request tree, if all pages are at home at the host.
  std::optional<RequestTree> tree() const { return request_tree_of(where, node_count); }
  /// Whether node `index`, or the host, gets requests.
  bool is_asked(std::uint32_t index) const {
    return pages_at(index) > 0 || (index < node_count && tree() && tree()->count_below(index) > 0);
  }
  /// The shape of the frames of resident pages.
  CacheShape resident_shape() const { return {resident_count, page_size_bytes()}; }
  /// Number of pages at home at node `index`, or the host, without those that all nodes hold.
  std::uint32_t pages_at(std::uint32_t index) const { return homes().count_at(index, page_count - leading_pages); }
};

}  // namespace dmpc::svm
