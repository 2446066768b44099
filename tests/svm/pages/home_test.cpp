#include "svm/pages/home.h"

#include <doctest/doctest.h>

#include <random>

namespace home_test {

using namespace dmpc;
using svm::Homes;
using svm::PageId;

TEST_CASE("page p is at home at node p mod N, in slot p div N") {
  for (const std::uint32_t nodes : {1U, 2U, 3U, 7U, 8U, 64U, 641U, 4096U, 65535U}) {
    const Homes homes(nodes);
    for (const std::uint32_t page : {0U, 1U, 2U, 63U, 64U, 65535U, 65536U, 1U << 25U, 0xfffffffeU, 0xffffffffU}) {
      CHECK(homes.place_of(PageId{page}) == Homes::Place{page % nodes, page / nodes});
    }
  }
}

TEST_CASE("the home of random pages agrees with division, also just beside multiples of N") {
  std::mt19937 generator(1);
  for (int i = 0; i < 20000; ++i) {
    const auto nodes = 1U + static_cast<std::uint32_t>(generator()) % 65535U;
    const auto random = static_cast<std::uint32_t>(generator());
    const std::uint32_t page = i % 3 == 0 ? random / nodes * nodes - 1 : random;
    REQUIRE(Homes(nodes).place_of(PageId{page}) == Homes::Place{page % nodes, page / nodes});
  }
}

TEST_CASE("a page's place leads back to the page") {
  const Homes homes(7);
  for (std::uint32_t page = 0; page < 100; ++page) {
    CHECK(homes.page_at(homes.place_of(PageId{page})) == PageId{page});
  }
}

TEST_CASE("all nodes together are home to every page once, as evenly as can be") {
  for (const std::uint32_t page_count : {0U, 1U, 6U, 7U, 8U, 100U}) {
    std::uint32_t sum = 0;
    for (std::uint32_t node = 0; node < 7; ++node) {
      const std::uint32_t count = Homes(7).count_at(node, page_count);
      CHECK((count == page_count / 7 || count == page_count / 7 + 1));
      sum += count;
    }
    CHECK(sum == page_count);
  }
}

TEST_CASE("where the host is home, it has every page, and no node has one") {
  const Homes homes = svm::homes_of(svm::PageHomes::host, 7);
  for (const std::uint32_t page : {0U, 1U, 6U, 7U, 8U, 65536U, 0xffffffffU}) {
    CHECK(homes.place_of(PageId{page}) == Homes::Place{7, page});
    CHECK(homes.page_at({7, page}) == PageId{page});
  }
  for (std::uint32_t node = 0; node < 9; ++node) {
    CHECK(homes.count_at(node, 100) == (node == 7 ? 100 : 0));
  }
  CHECK(svm::homes_of(svm::PageHomes::spread, 7).place_of(PageId{9}) == Homes::Place{2, 1});
}

TEST_CASE("a machine without nodes, or with too many, is refused") {
  CHECK_THROWS_AS(Homes(0), core::InternalError);
  CHECK_THROWS_AS(Homes(65536), core::InternalError);
}

}  // namespace home_test
