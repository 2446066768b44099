#include "svm/pages/cache.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <iterator>
#include <list>
#include <random>
#include <vector>

#include "core/base/expect.h"
#include "tests/support/small_pages.h"

namespace pages_cache_test {

using namespace dmpc;
using svm::Cache;
using svm::CacheShape;
using svm::PageId;
using svm::Replacement;
using tests::page_size;

namespace {

constexpr auto all_policies = {Replacement::lru,        Replacement::clock,    Replacement::fifo,          Replacement::random,
                               Replacement::two_queues, Replacement::adaptive, Replacement::small_and_main};

/// A cache in a memory of exactly the size that it says it needs.
struct SmallCache {
  explicit SmallCache(std::uint32_t frames, Replacement replacement = Replacement::lru, std::uint32_t seed = 0)
      : SmallCache(CacheShape{frames, page_size, replacement}, seed) {}
  SmallCache(const CacheShape& shape, std::uint32_t seed) : memory(Cache::layout(shape)), cache(memory, shape, seed) {}
  PageId install(std::uint32_t page) { return cache.install(PageId{page}, bytes_of(page)); }
  bool refer(std::uint32_t page) {
    const std::uint32_t frame = cache.frame_of(PageId{page});
    if (frame == Cache::no_frame) {
      return false;
    }
    cache.touch(frame);
    const std::byte* bytes = cache.bytes_of(frame);
    return std::equal(bytes, bytes + page_size, bytes_of(page).begin());
  }
  std::vector<std::byte> bytes_of(std::uint32_t page) { return std::vector<std::byte>(page_size, std::byte(page * 37 + 1)); }

  nodes::LocalMemory memory;
  Cache cache;
};

/// The policies as their definitions say, on a list of pages: for lru the newest first, for the others in the order of arrival.
struct Model {
  bool refer(std::uint32_t page) {
    const auto place = std::find_if(pages.begin(), pages.end(), [page](const Entry& entry) { return entry.page == page; });
    if (place == pages.end()) {
      return false;
    }
    place->is_marked = true;
    if (replacement == Replacement::lru) {
      pages.splice(pages.begin(), pages, place);
    }
    return true;
  }
  PageId install(std::uint32_t page) {
    const PageId evicted = pages.size() == frames ? evict() : svm::no_page;
    pages.push_front({page, true});
    return evicted;
  }
  PageId evict() {
    while (replacement == Replacement::clock && pages.back().is_marked) {  // a second chance
      pages.back().is_marked = false;
      pages.splice(pages.begin(), pages, std::prev(pages.end()));
    }
    const PageId evicted{pages.back().page};
    pages.pop_back();
    return evicted;
  }
  struct Entry {
    std::uint32_t page;
    bool is_marked;
  };
  std::size_t frames;
  Replacement replacement;
  std::list<Entry> pages = {};
};

void compare_with_model(Replacement replacement, std::uint32_t frames, std::uint32_t page_count, std::uint32_t seed,
                        bool clustered) {
  SmallCache small(frames, replacement);
  Model model{frames, replacement};
  std::mt19937 generator(seed);
  for (int i = 0; i < 3000; ++i) {
    const auto random = static_cast<std::uint32_t>(generator() % page_count);
    const std::uint32_t page = clustered ? random / (1U + static_cast<std::uint32_t>(generator()) % 8U) : random * 64U;
    INFO(svm::name_of(replacement), ", frames ", frames, ", page_count ", page_count, ", seed ", seed, ", i ", i);
    const bool cached = model.refer(page);
    REQUIRE(small.refer(page) == cached);
    if (!cached) {
      REQUIRE(small.install(page) == model.install(page));
    }
  }
}

}  // namespace

TEST_CASE("a cache finds and evicts what a brute-force list does under lru, clock and fifo") {
  for (const Replacement replacement : {Replacement::lru, Replacement::clock, Replacement::fifo}) {
    for (const std::uint32_t frames : {1U, 2U, 3U, 4U, 7U, 16U, 63U, 64U, 65U, 100U, 300U}) {
      for (const std::uint32_t seed : {1U, 2U}) {
        compare_with_model(replacement, frames, frames + 1, seed, true);
        compare_with_model(replacement, frames, 2 * frames + 3, seed, false);
        compare_with_model(replacement, frames, 20 * frames, seed, true);
      }
    }
  }
}

TEST_CASE("an empty cache finds nothing") {
  SmallCache small(4);
  CHECK(small.cache.frame_of(PageId{0}) == Cache::no_frame);
  CHECK(small.cache.frame_of(PageId{12345}) == Cache::no_frame);
}

TEST_CASE("a cache without frames finds nothing and takes nothing") {
  for (const Replacement replacement : all_policies) {
    SmallCache small(0, replacement);
    CHECK_FALSE(small.refer(1));
    CHECK_THROWS_AS(small.install(1), core::InternalError);
  }
}

TEST_CASE("a cache of one frame holds the page installed last") {
  for (const Replacement replacement : all_policies) {
    SmallCache small(1, replacement);
    CHECK(small.install(5) == svm::no_page);
    CHECK(small.refer(5));
    CHECK(small.install(6) == PageId{5});
    CHECK_FALSE(small.refer(5));
    CHECK(small.refer(6));
  }
}

TEST_CASE("empty frames are filled before a page is evicted") {
  for (const Replacement replacement : all_policies) {
    SmallCache small(3, replacement);
    for (std::uint32_t page = 0; page < 3; ++page) {
      CHECK(small.install(page) == svm::no_page);
    }
    CHECK(small.refer(0));
    CHECK(small.install(3) != svm::no_page);
  }
}

TEST_CASE("a page is installed whole, and only where it is absent") {
  SmallCache small(2);
  small.install(1);
  CHECK_THROWS_AS(small.install(1), core::InternalError);
  CHECK_THROWS_AS(small.cache.install(PageId{2}, std::vector<std::byte>(page_size - 1)), core::InternalError);
}

TEST_CASE("a cache takes exactly the memory that it says it needs") {
  for (const Replacement replacement : all_policies) {
    for (const std::uint32_t frames : {0U, 1U, 2U, 31U, 64U, 1000U}) {
      SmallCache small(frames, replacement);
      CHECK(small.memory.used().bytes == nodes::MemoryPlan(Cache::layout({frames, page_size, replacement})).bytes);
    }
  }
}

}  // namespace pages_cache_test
