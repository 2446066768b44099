// What a node keeps of the database, piece by piece.
#pragma once

#include <cstddef>
#include <cstdint>

#include "svm/pages/home_pages.h"
#include "svm/plan.h"

namespace dmpc::svm {

/// Calls visit(offset in bytes, bytes) for each piece that the program of node `index` reads when it is made, in its order.
template <class Visit>
void for_each_piece(const Plan& plan, std::uint32_t index, const Visit& visit) {
  const PageCapacity pages = plan.pages();
  const std::size_t page_bytes = pages.page_size_bytes();
  if (plan.request.strategy == Strategy::replicated) {
    return visit(std::size_t{0}, pages.database_bytes());
  }
  if (plan.request.strategy == Strategy::forest) {
    visit(std::size_t{0}, pages.forest_bytes());
  }
  HomePages::for_each_page(pages, index, [&](std::size_t offset) { visit(offset, page_bytes); });
  for (const PageId page : pages.resident) {
    visit(index_of(page) * page_bytes, page_bytes);
  }
}

}  // namespace dmpc::svm
