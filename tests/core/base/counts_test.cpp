#include "core/base/counts.h"

#include <doctest/doctest.h>

#include <array>
#include <cstdint>
#include <vector>

namespace dmpc::core::counts_test {
namespace {

struct Pair {
  std::uint64_t left = 0, right = 0;

  std::uint64_t both() const { return left + right; }
};
struct Several {
  std::uint64_t one = 0;
  std::array<std::uint64_t, 3> three{};
  Pair pair;
  std::array<Pair, 2> pairs{};
};
struct WithHalves {
  std::uint64_t one = 0;
  std::uint32_t half = 0, other_half = 0;
};
struct WithFlag {
  std::uint64_t one = 0;
  bool flag = false;
};
struct WithTime {
  std::uint64_t one = 0;
  double seconds = 0;
};

}  // namespace

TEST_CASE("counts alone are summed one by one, in arrays and in each other, too") {
  Several sum{1, {2, 3, 4}, {5, 6}, {{{7, 8}, {9, 10}}}};
  const Several more{10, {20, 30, 40}, {50, 60}, {{{70, 80}, {90, 100}}}};
  CHECK(&add_counts(sum, more) == &sum);
  CHECK(sum.one == 11);
  CHECK(sum.three == std::array<std::uint64_t, 3>{22, 33, 44});
  CHECK(sum.pair.right == 66);
  CHECK(sum.pairs[0].left == 77);
  CHECK(sum.pairs[1].both() == 209);
}

TEST_CASE("what has anything but counts is not summed so") {
  CHECK(MadeOfCounts<Several>);
  CHECK_FALSE(MadeOfCounts<WithHalves>);
  CHECK_FALSE(MadeOfCounts<WithFlag>);
  CHECK_FALSE(MadeOfCounts<WithTime>);
}

TEST_CASE("the total of nothing is nothing, of some the sum of a part of each") {
  std::vector<Several> items;
  CHECK(total_of(items, &Several::pair).both() == 0);
  items.push_back({.pair = {1, 2}});
  items.push_back({.pair = {3, 4}});
  CHECK(total_of(items, &Several::pair).left == 4);
  CHECK(total_of(items, [](const Several& item) { return item.pair; }).right == 6);
}

}  // namespace dmpc::core::counts_test
