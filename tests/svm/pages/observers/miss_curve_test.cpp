#include "svm/pages/observers/miss_curve.h"

#include <doctest/doctest.h>

#include "tests/support/references.h"

namespace miss_curve_test {

using namespace dmpc;
using namespace dmpc::tests;
using svm::MissCurve;

namespace {

void compare_with_simulation(const References& references) {
  const MissCurve curve(references);
  for (const std::uint32_t frames : {0U, 1U, 2U, 3U, 8U, 64U, 200U, 512U, 100'000U}) {
    CAPTURE(frames);
    CHECK(curve.misses(frames) == lru_misses(references, frames));
  }
}

}  // namespace

TEST_CASE("without references nothing is missed") {
  for (const MissCurve& curve : {MissCurve(), MissCurve(References())}) {
    CHECK(curve.references() == 0);
    CHECK(curve.misses(0) == 0);
    CHECK(curve.misses(1) == 0);
    CHECK(curve.sufficient_pages() == 0);
    CHECK(curve.distinct_pages() == 0);
  }
}

TEST_CASE("a page alone is missed once in any cache, every time without one") {
  const MissCurve curve(references_of({5, 5, 5}));
  CHECK(curve.misses(0) == 3);
  CHECK(curve.misses(1) == 1);
  CHECK(curve.misses(2) == 1);
  CHECK(curve.sufficient_pages() == 1);
}

TEST_CASE("stack distances worked out by hand") {
  // Pages:     1  2  3  1  1  3  2  4  2
  // Distances: -  -  -  2  0  1  2  -  1
  const MissCurve curve(references_of({1, 2, 3, 1, 1, 3, 2, 4, 2}));
  CHECK(curve.references() == 9);
  CHECK(curve.cold_misses() == 4);
  CHECK(curve.misses(0) == 9);
  CHECK(curve.misses(1) == 8);
  CHECK(curve.misses(2) == 6);
  CHECK(curve.misses(3) == 4);
  CHECK(curve.misses(4) == 4);
  CHECK(curve.sufficient_pages() == 3);
  CHECK(curve.distinct_pages() == 4);
}

TEST_CASE("going round one page more than there are frames misses always") {
  References references;
  for (std::uint32_t i = 0; i < 5000; ++i) {
    references.push_back(svm::PageId{i % 10 * 1000});
  }
  const MissCurve curve(references);
  CHECK(curve.misses(9) == 5000);
  CHECK(curve.misses(10) == 10);
}

TEST_CASE("the curve equals LRU caches simulated one by one, to the last miss") {
  for (const std::uint32_t seed : {1U, 2U, 3U}) {
    CAPTURE(seed);
    compare_with_simulation(random_references(seed, 6000, 300));
    compare_with_simulation(random_references(seed, 6000, 2));
    compare_with_simulation(random_references(seed, 3000, 3000));
  }
}

TEST_CASE("the curve of several nodes is the sum of theirs, and the node with most pages counts") {
  const References few = random_references(1, 2000, 50), many = random_references(2, 3000, 200);
  for (const bool many_first : {false, true}) {
    MissCurve sum(many_first ? many : few);
    sum += MissCurve(many_first ? few : many);
    CHECK(sum.references() == 5000);
    CHECK(sum.distinct_pages() == MissCurve(many).distinct_pages());
    for (const std::uint32_t frames : {0U, 1U, 20U, 100U, 300U}) {
      CHECK(sum.misses(frames) == lru_misses(few, frames) + lru_misses(many, frames));
    }
  }
}

}  // namespace miss_curve_test
