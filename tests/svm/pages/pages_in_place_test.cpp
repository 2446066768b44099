#include "svm/pages/pages_in_place.h"

#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace dmpc::svm::pages_in_place_test {

namespace {

constexpr std::size_t page_size = 512;

/// For a node whose memory keeps immutable bytes in this way, and a database of this many pages.
std::optional<PagesInPlace> pages_of(nodes::Immutable immutable, const std::vector<std::byte>& database) {
  const nodes::LocalMemory memory(nodes::MemoryPlan{}, immutable);
  PageCapacity capacity;
  capacity.page_count = static_cast<std::uint32_t>(database.size() / page_size);
  capacity.cache = {.frame_count = 2, .page_size_bytes = page_size};
  return PagesInPlace::of(memory, capacity, nodes::ByteSource(std::span(database)));
}

}  // namespace

TEST_CASE("a page in place is absent, in a frame or here for good, and lies where the database has it") {
  const std::vector<std::byte> database(3 * page_size);
  std::optional<PagesInPlace> pages = pages_of(nodes::Immutable::is_referred_to, database);
  REQUIRE(pages);
  for (const std::uint32_t page : {0U, 1U, 2U}) {
    CHECK(pages->frame_of(PageId{page}) == PagesInPlace::absent);
    CHECK(pages->bytes_of(PageId{page}) == database.data() + page * page_size);
  }
  pages->put(PageId{1}, 0);
  pages->put(PageId{2}, PagesInPlace::for_good);
  CHECK(pages->frame_of(PageId{0}) == PagesInPlace::absent);
  CHECK(pages->frame_of(PageId{1}) == 0);
  CHECK(pages->frame_of(PageId{2}) == PagesInPlace::for_good);
  pages->put(PageId{1}, PagesInPlace::absent);
  CHECK(pages->frame_of(PageId{1}) == PagesInPlace::absent);
  CHECK(pages->frame_of(PageId{3}) == PagesInPlace::absent);
  CHECK(pages->frame_of(no_page) == PagesInPlace::absent);
}

TEST_CASE("a cache whose pages are in place evicts what one with a table of its own does") {
  constexpr std::uint32_t page_count = 9;
  const std::vector<std::byte> database(page_count * page_size);
  const CacheShape shape{.frame_count = 3, .page_size_bytes = page_size};
  nodes::LocalMemory memory(Cache::layout(shape) + Cache::layout(shape), nodes::Immutable::is_referred_to);
  Cache with_table(memory, shape, 0), with_places(memory, shape, 0);
  std::optional<PagesInPlace> places = pages_of(nodes::Immutable::is_referred_to, database);
  REQUIRE(places);
  for (std::uint32_t i = 0; i < 200; ++i) {
    const PageId page{i * i % page_count};
    const std::uint32_t frame = with_table.frame_of(page);
    REQUIRE(places->find(page) == frame);
    if (frame != Cache::no_frame) {
      with_table.touch(frame);
      with_places.touch(frame);
      continue;
    }
    const std::span<const std::byte> bytes(places->bytes_of(page), page_size);
    const PageId evicted = with_table.install(page, bytes);
    CHECK(with_places.install(page, bytes, *places) == evicted);
    CHECK(with_places.frame_of(page) == Cache::no_frame);
    CHECK(places->find(evicted) == Cache::no_frame);
  }
}

TEST_CASE("pages are looked up in place on modelled machines alone, and only as long as the table is small") {
  const std::vector<std::byte> few(page_size), many((std::size_t{PagesInPlace::pages_max} + 1) * page_size);
  CHECK(pages_of(nodes::Immutable::is_referred_to, few));
  CHECK_FALSE(pages_of(nodes::Immutable::is_copied, few));
  CHECK_FALSE(pages_of(nodes::Immutable::is_referred_to, many));
}

}  // namespace dmpc::svm::pages_in_place_test
