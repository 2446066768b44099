// The pages that a node, or the host, stores permanently.
#pragma once

#include <cstddef>
#include <cstdint>

#include "nodes/byte_source.h"
#include "nodes/immutable_pieces.h"
#include "nodes/node.h"
#include "svm/pages/home.h"
#include "svm/pages/page.h"
#include "svm/pages/page_capacity.h"

namespace dmpc::svm {

/// The homes of pages after those that every node holds, and the bytes of those at home here. Not thread-safe.
class HomePages {
 public:
  /// Puts the node's pages, from `database`, into its local memory (nodes/immutable_pieces.h).
  HomePages(nodes::Node& node, const PageCapacity& capacity, const nodes::ByteSource& database);
  /// The memory that the constructor takes at node `index`.
  static nodes::MemoryPlan layout(const PageCapacity& capacity, std::uint32_t index);
  /// Calls visit(offset in bytes) for each page that the constructor reads at node `index`, in its order.
  template <class Visit>
  static void for_each_page(const PageCapacity& capacity, std::uint32_t index, const Visit& visit) {
    const Homes homes = capacity.homes();
    for (std::uint32_t slot = 0; slot < capacity.pages_at(index); ++slot) {
      const std::size_t page = index_of(homes.page_at({index, slot})) + capacity.leading_pages;
      visit(page * capacity.page_size_bytes());
    }
  }

  /// The index of the page's home: a node or the host.
  std::uint32_t home_of(PageId page) const { return place_of(page).node; }
  /// A page's first byte, or nullptr if it is at home elsewhere, or nowhere.
  const std::byte* find(PageId page) const {
    const Homes::Place place = place_of(page);
    return place.node == self_ && place.slot < count_ ? pages_.at(place.slot) : nullptr;
  }

 private:
  Homes::Place place_of(PageId page) const { return homes_.place_of(PageId{index_of(page) - first_page_}); }

  Homes homes_;
  std::uint32_t self_;
  std::uint32_t first_page_;
  std::uint32_t count_;
  nodes::ImmutablePieces pages_;
};

/// Takes the credits for a node's requests to each other node, or to its parent if the host is home to all.
void grant_requests(nodes::Node& node, const PageCapacity& capacity);

}  // namespace dmpc::svm
