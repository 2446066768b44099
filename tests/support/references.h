// Sequences of page references, and caches that are nothing but a list.
#pragma once

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <list>
#include <random>
#include <span>
#include <vector>

#include "svm/pages/page.h"

namespace dmpc::tests {

using References = std::vector<svm::PageId>;

inline References references_of(std::initializer_list<std::uint32_t> pages) {
  References references;
  for (const std::uint32_t page : pages) {
    references.push_back(svm::PageId{page});
  }
  return references;
}

/// References of pages below `page_count`: near the last one, as a walk's are, or anywhere.
inline References random_references(std::uint32_t seed, std::uint32_t count, std::uint32_t page_count) {
  std::mt19937 generator(seed);
  References references;
  std::uint32_t page = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto drawn = static_cast<std::uint32_t>(generator());
    page = drawn % 4 == 0 ? drawn / 4 % page_count : (page + drawn / 4 % 5) % page_count;
    references.push_back(svm::PageId{page});
  }
  return references;
}

/// Misses of an LRU cache by its definition: a list, newest first.
inline std::uint64_t lru_misses(std::span<const svm::PageId> references, std::size_t frames) {
  std::list<svm::PageId> pages;
  std::uint64_t misses = 0;
  for (const svm::PageId page : references) {
    const auto place = std::find(pages.begin(), pages.end(), page);
    if (place != pages.end()) {
      pages.erase(place);
    } else {
      ++misses;
    }
    pages.push_front(page);
    if (pages.size() > frames) {
      pages.pop_back();
    }
  }
  return misses;
}

}  // namespace dmpc::tests
