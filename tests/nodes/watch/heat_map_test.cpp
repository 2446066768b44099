#include "nodes/watch/heat_map.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <thread>
#include <vector>

#include "core/base/expect.h"

namespace dmpc::nodes {

TEST_CASE("a heat map keeps numbers of the kinds that it was made for, and no others") {
  HeatMap map(3, std::array{HeatKind::rays, HeatKind::depth, HeatKind::rays});
  map.add(HeatKind::rays, 1, 5);
  map.add(HeatKind::rays, 1, 2);
  map.raise(HeatKind::depth, 2, 4);
  map.raise(HeatKind::depth, 2, 3);
  map.set(HeatKind::node, 0, 7);
  CHECK(map.pixel_count() == 3);
  CHECK(std::ranges::equal(map.values(HeatKind::rays), std::array{0, 7, 0}));
  CHECK(std::ranges::equal(map.values(HeatKind::depth), std::array{0, 0, 4}));
  CHECK(map.sum(HeatKind::rays) == 7);
  CHECK_FALSE(map.has(HeatKind::node));
  CHECK(map.values(HeatKind::node).empty());
  CHECK(map.sum(HeatKind::node) == 0);
}

TEST_CASE("a heat map without kinds keeps nothing, and one without pixels has none") {
  HeatMap nothing(2, {});
  nothing.add(HeatKind::faults, 1, 1);
  CHECK_FALSE(nothing.has(HeatKind::faults));
  HeatMap empty(0, std::array{HeatKind::faults});
  CHECK_THROWS_AS(empty.add(HeatKind::faults, 0, 1), core::InternalError);
}

TEST_CASE("heat beside the picture is an error, recorded or not") {
  HeatMap map(2, std::array{HeatKind::rays});
  CHECK_THROWS_AS(map.add(HeatKind::rays, 2, 1), core::InternalError);
  CHECK_THROWS_AS(map.raise(HeatKind::depth, 2, 1), core::InternalError);
  CHECK_THROWS_AS(map.set(HeatKind::node, 0xffffffffU, 1), core::InternalError);
}

TEST_CASE("nothing is lost when threads add to one pixel, and the highest of all numbers stays") {
  constexpr std::uint64_t rounds = 10'000;
  HeatMap map(1, std::array{HeatKind::rays, HeatKind::depth});
  const auto write = [&map](std::uint64_t first) {
    for (std::uint64_t i = first; i < 2 * rounds; i += 2) {
      map.add(HeatKind::rays, 0, 1);
      map.raise(HeatKind::depth, 0, i);
    }
  };
  std::thread even(write, 0), odd(write, 1);
  even.join();
  odd.join();
  CHECK(map.values(HeatKind::rays)[0] == 2 * rounds);
  CHECK(map.values(HeatKind::depth)[0] == 2 * rounds - 1);
}

}  // namespace dmpc::nodes
