#include "nodes/ranks/counting_talk.h"

#include <doctest/doctest.h>

namespace dmpc::tests::counting_waves_test {
namespace {

using nodes::CountingWaves;
using nodes::Counts;

TEST_CASE("one wave in which as many packets were received as sent proves nothing, two do") {
  CountingWaves waves(2);
  waves.count(0, {5, 3, 0});
  CHECK_FALSE(waves.end_wave());
  waves.count(1, {3, 5, 1});
  CHECK_FALSE(waves.end_wave());
  waves.count(0, {5, 3, 0});
  waves.count(1, {3, 5, 1});
  CHECK(waves.end_wave() == Counts{8, 8, 1});
}

TEST_CASE("what moved between two waves is seen, though each has equal sums") {
  CountingWaves waves(2);
  waves.count(0, {5, 3, 0});
  waves.count(1, {3, 5, 0});
  CHECK_FALSE(waves.end_wave());
  waves.count(0, {6, 3, 0});
  waves.count(1, {3, 6, 0});
  CHECK_FALSE(waves.end_wave());
}

TEST_CASE("packets under way keep waves going for as long as they are") {
  CountingWaves waves(2);
  for (int wave = 0; wave < 5; ++wave) {
    waves.count(0, {5, 3, 0});
    waves.count(1, {3, 4, 0});
    CHECK_FALSE(waves.end_wave());
  }
  waves.count(0, {5, 3, 0});
  waves.count(1, {3, 5, 0});
  CHECK_FALSE(waves.end_wave());
  waves.count(0, {5, 3, 0});
  waves.count(1, {3, 5, 0});
  CHECK(waves.end_wave() == Counts{8, 8, 0});
  CHECK(waves.waves() == 7);
}

TEST_CASE("a rank may be one wave ahead of those that have not heard all, and no more") {
  CountingWaves waves(3);
  waves.count(1, {1, 1, 0});
  waves.count(1, {2, 2, 0});
  CHECK_FALSE(waves.has_counted(0));
  CHECK_THROWS_AS(waves.count(1, {3, 3, 0}), core::InternalError);
  waves.count(0, {});
  waves.count(2, {});
  CHECK_FALSE(waves.end_wave());
  CHECK(waves.has_counted(1));
  CHECK_FALSE(waves.has_counted(0));
}

}  // namespace
}  // namespace dmpc::tests::counting_waves_test
