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

TEST_CASE("what was written to another map is added, but of depth and node the larger number stays") {
  constexpr std::array kinds{HeatKind::faults, HeatKind::depth, HeatKind::node, HeatKind::time};
  HeatMap here(3, kinds), elsewhere(3, kinds);
  here.add(HeatKind::faults, 0, 5);
  here.raise(HeatKind::depth, 1, 4);
  here.set(HeatKind::node, 1, 2);
  elsewhere.add(HeatKind::faults, 0, 7);
  elsewhere.add(HeatKind::time, 2, 1'000'000'000'000);
  elsewhere.raise(HeatKind::depth, 1, 3);
  elsewhere.raise(HeatKind::depth, 2, 1);
  elsewhere.set(HeatKind::node, 2, 9);
  here.add(elsewhere.bytes());
  const auto values = [&](HeatKind kind) {
    return std::vector<std::uint64_t>(here.values(kind).begin(), here.values(kind).end());
  };
  CHECK(values(HeatKind::faults) == std::vector<std::uint64_t>{12, 0, 0});
  CHECK(values(HeatKind::depth) == std::vector<std::uint64_t>{0, 4, 1});
  CHECK(values(HeatKind::node) == std::vector<std::uint64_t>{0, 2, 9});
  CHECK(values(HeatKind::time) == std::vector<std::uint64_t>{0, 0, 1'000'000'000'000});
}

TEST_CASE("a map of other pixels or kinds is not added") {
  HeatMap map(2, std::array{HeatKind::rays});
  CHECK_THROWS_AS(map.add(HeatMap(3, std::array{HeatKind::rays}).bytes()), core::InternalError);
  CHECK_THROWS_AS(map.add(HeatMap(2, std::array{HeatKind::depth}).bytes()), core::InternalError);
  CHECK_THROWS_AS(map.add(HeatMap(2, std::array{HeatKind::rays, HeatKind::time}).bytes()), core::InternalError);
}

}  // namespace dmpc::nodes
