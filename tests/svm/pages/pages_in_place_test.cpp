#include "svm/pages/pages_in_place.h"

#include <doctest/doctest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace dmpc::svm::pages_in_place_test {

namespace {

constexpr std::size_t page_size = 512;

/// Of a node whose memory keeps what lasts so, and a database of so many pages.
std::optional<PagesInPlace> pages_of(nodes::Lasting lasting, const std::vector<std::byte>& database) {
  const nodes::LocalMemory memory(nodes::MemoryPlan{}, lasting);
  PageCapacity capacity;
  capacity.page_count = static_cast<std::uint32_t>(database.size() / page_size);
  capacity.cache = {.frame_count = 2, .page_size_bytes = page_size};
  return PagesInPlace::of(memory, capacity, nodes::ByteSource(std::span(database)));
}

}  // namespace

TEST_CASE("a page in place is absent, in a frame or here for good, and lies where the database has it") {
  const std::vector<std::byte> database(3 * page_size);
  std::optional<PagesInPlace> pages = pages_of(nodes::Lasting::is_referred_to, database);
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

TEST_CASE("pages are looked up in place on modelled machines alone, and only as long as the table is small") {
  const std::vector<std::byte> few(page_size), many((std::size_t{PagesInPlace::pages_max} + 1) * page_size);
  CHECK(pages_of(nodes::Lasting::is_referred_to, few));
  CHECK_FALSE(pages_of(nodes::Lasting::is_copied, few));
  CHECK_FALSE(pages_of(nodes::Lasting::is_referred_to, many));
}

}  // namespace dmpc::svm::pages_in_place_test
