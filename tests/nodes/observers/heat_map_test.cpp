#include "nodes/observers/heat_map.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <thread>
#include <vector>

#include "core/base/expect.h"
#include "tests/nodes/observers/toy_kind.h"

namespace dmpc::nodes::heat_map_test {

TEST_CASE("a heat map keeps numbers of the kinds that it was made for, and no others") {
  HeatMap map(3, std::array{ToyKind::steps, ToyKind::depth, ToyKind::steps});
  map.add(ToyKind::steps, 1, 5);
  map.add(ToyKind::steps, 1, 2);
  map.raise(ToyKind::depth, 2, 4);
  map.raise(ToyKind::depth, 2, 3);
  map.set(ToyKind::node, 0, 7);
  CHECK(map.item_count() == 3);
  CHECK(std::ranges::equal(map.values(ToyKind::steps), std::array{0, 7, 0}));
  CHECK(std::ranges::equal(map.values(ToyKind::depth), std::array{0, 0, 4}));
  CHECK(map.sum(ToyKind::steps) == 7);
  CHECK_FALSE(map.has(ToyKind::node));
  CHECK(map.values(ToyKind::node).empty());
  CHECK(map.sum(ToyKind::node) == 0);
}

TEST_CASE("a heat map without kinds keeps nothing, and one without items has none") {
  HeatMap nothing(2, std::array<ToyKind, 0>{});
  nothing.add(ToyKind::bites, 1, 1);
  CHECK_FALSE(nothing.has(ToyKind::bites));
  HeatMap empty(0, std::array{ToyKind::bites});
  CHECK_THROWS_AS(empty.add(ToyKind::bites, 0, 1), core::InternalError);
}

TEST_CASE("heat on an item that there is not is an error, recorded or not") {
  HeatMap map(2, std::array{ToyKind::steps});
  CHECK_THROWS_AS(map.add(ToyKind::steps, 2, 1), core::InternalError);
  CHECK_THROWS_AS(map.raise(ToyKind::depth, 2, 1), core::InternalError);
  CHECK_THROWS_AS(map.set(ToyKind::node, 0xffffffffU, 1), core::InternalError);
}

TEST_CASE("nothing is lost when threads add to one item, and the highest of all numbers stays") {
  constexpr std::uint64_t rounds = 10'000;
  HeatMap map(1, std::array{ToyKind::steps, ToyKind::depth});
  const auto write = [&map](std::uint64_t first) {
    for (std::uint64_t i = first; i < 2 * rounds; i += 2) {
      map.add(ToyKind::steps, 0, 1);
      map.raise(ToyKind::depth, 0, i);
    }
  };
  std::thread even(write, 0), odd(write, 1);
  even.join();
  odd.join();
  CHECK(map.values(ToyKind::steps)[0] == 2 * rounds);
  CHECK(map.values(ToyKind::depth)[0] == 2 * rounds - 1);
}

TEST_CASE("what was written to another map is added, but of depth and node the larger number stays") {
  constexpr std::array kinds{ToyKind::bites, ToyKind::depth, ToyKind::node, ToyKind::time};
  HeatMap here(3, kinds), elsewhere(3, kinds);
  here.add(ToyKind::bites, 0, 5);
  here.raise(ToyKind::depth, 1, 4);
  here.set(ToyKind::node, 1, 2);
  elsewhere.add(ToyKind::bites, 0, 7);
  elsewhere.add(ToyKind::time, 2, 1'000'000'000'000);
  elsewhere.raise(ToyKind::depth, 1, 3);
  elsewhere.raise(ToyKind::depth, 2, 1);
  elsewhere.set(ToyKind::node, 2, 9);
  here.add(elsewhere.bytes());
  const auto values = [&](ToyKind kind) {
    return std::vector<std::uint64_t>(here.values(kind).begin(), here.values(kind).end());
  };
  CHECK(values(ToyKind::bites) == std::vector<std::uint64_t>{12, 0, 0});
  CHECK(values(ToyKind::depth) == std::vector<std::uint64_t>{0, 4, 1});
  CHECK(values(ToyKind::node) == std::vector<std::uint64_t>{0, 2, 9});
  CHECK(values(ToyKind::time) == std::vector<std::uint64_t>{0, 0, 1'000'000'000'000});
}

TEST_CASE("a map of other items or kinds is not added") {
  HeatMap map(2, std::array{ToyKind::steps});
  CHECK_THROWS_AS(map.add(HeatMap(3, std::array{ToyKind::steps}).bytes()), core::InternalError);
  CHECK_THROWS_AS(map.add(HeatMap(2, std::array{ToyKind::depth}).bytes()), core::InternalError);
  CHECK_THROWS_AS(map.add(HeatMap(2, std::array{ToyKind::steps, ToyKind::time}).bytes()), core::InternalError);
}

}  // namespace dmpc::nodes::heat_map_test
