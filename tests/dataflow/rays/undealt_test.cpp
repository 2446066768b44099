#include "dataflow/rays/undealt.h"

#include <doctest/doctest.h>

#include <vector>

#include "core/base/expect.h"

namespace undealt_test {

using namespace dmpc;
using core::PixelMask;
using dataflow::DealtPrimaries;
using dataflow::Undealt;

namespace {

constexpr std::uint64_t no_bound = ~std::uint64_t{0};

/// All that may be dealt to a node now, ray by ray.
std::vector<std::uint64_t> rays_for(Undealt& undealt, std::uint32_t node) {
  std::vector<std::uint64_t> rays;
  while (undealt.has(node)) {
    const DealtPrimaries packet = undealt.take(node);
    for (std::uint32_t i = 0; i < packet.count; ++i) {
      for (std::uint64_t ray = 0; ray < packet.runs[i].count; ++ray) {
        rays.push_back(packet.runs[i].first + ray);
      }
    }
  }
  return rays;
}

using Rays = std::vector<std::uint64_t>;

}  // namespace

TEST_CASE("every ray is dealt once, to its node, in order") {
  Undealt undealt(2, no_bound);
  CHECK(undealt.is_empty());
  undealt.begin_pass({{{0, 2}, {5, 1}}, {{2, 3}}}, {0, 1}, PixelMask(6));
  CHECK_FALSE(undealt.is_empty());
  CHECK(rays_for(undealt, 0) == Rays{0, 1, 5});
  CHECK(rays_for(undealt, 1) == Rays{2, 3, 4});
  CHECK(undealt.is_empty());
  CHECK(undealt.begun() == PixelMask(6, true));
}

TEST_CASE("no run that is dealt is longer than the bound, and no packet has more runs than it has room for") {
  Undealt undealt(1, 2);
  undealt.begin_pass({{{0, 301}}}, {0, 1}, PixelMask(301));
  const DealtPrimaries packet = undealt.take(0);
  CHECK(packet.count == packet.runs.size());
  CHECK(packet.runs[1].first == 2);
  CHECK(packet.runs[1].count == 2);
  CHECK(rays_for(undealt, 0).size() == 301 - 120);
}

TEST_CASE("a pass says which samples its rays are of") {
  Undealt undealt(1, no_bound);
  undealt.begin_pass({{{0, 4}}}, {2, 2}, PixelMask(2));
  CHECK(undealt.take(0).samples == core::SampleRange{2, 2});
}

TEST_CASE("when rays are held back, pixels that have begun are dealt to the end and no other is begun") {
  Undealt undealt(2, 3);
  undealt.begin_pass({{{0, 80 * 3}}, {{240, 30}}}, {0, 3}, PixelMask(90));
  undealt.take(0);  // 60 pixels
  undealt.hold_back();
  CHECK(undealt.holds_back());
  CHECK(undealt.is_empty());
  CHECK(undealt.begun().count() == 60);
  undealt.release();
  CHECK_FALSE(undealt.holds_back());
  CHECK(rays_for(undealt, 0).front() == 180);
  CHECK(rays_for(undealt, 1).size() == 30);
}

TEST_CASE("where places are in squares, the pixels that have begun are those of the places") {
  Undealt undealt(1, 1, dataflow::PixelOrder::squares(20, 16));
  undealt.begin_pass({{{0, 320}}}, {0, 1}, PixelMask(320));
  undealt.take(0);  // 60 places: three squares, and three rows of the fourth
  for (std::uint32_t pixel = 0; pixel < 320; ++pixel) {
    const std::uint32_t x = pixel % 20, y = pixel / 20;
    CHECK(undealt.begun().has(pixel) == (y < 4 && x < (y < 3 ? 16 : 12)));
  }
  undealt.hold_back();
  CHECK(undealt.begun().count() == 60);
  undealt.release();
  CHECK(rays_for(undealt, 0).front() == 60);
}

TEST_CASE("the other rays of a pixel that one node has begun are dealt to another") {
  Undealt undealt(2, 1);
  undealt.begin_pass({{{0, 1}, {2, 1}, {4, 1}}, {{1, 1}, {3, 1}, {5, 4}}}, {0, 2}, PixelMask(70));
  undealt.take(0);  // a sample of each of the pixels 0, 1 and 2
  undealt.hold_back();
  CHECK(rays_for(undealt, 1) == Rays{1, 3, 5});
  CHECK(undealt.is_empty());
  undealt.release();
  CHECK(rays_for(undealt, 1) == Rays{6, 7, 8});
}

TEST_CASE("where all pixels have begun nothing is held back") {
  Undealt undealt(2, no_bound);
  undealt.begin_pass({{{0, 1}}, {{1, 1}}}, {0, 2}, PixelMask(1));
  undealt.take(0);
  undealt.hold_back();
  CHECK_FALSE(undealt.holds_back());
  CHECK(rays_for(undealt, 1) == Rays{1});
}

TEST_CASE("pixels that were done before have begun") {
  Undealt undealt(1, no_bound);
  PixelMask done(3);
  done.add(1);
  undealt.begin_pass({{{0, 1}, {2, 1}}}, {0, 1}, done);
  CHECK(undealt.begun() == done);
  undealt.hold_back();
  CHECK(undealt.holds_back());
}

TEST_CASE("a node without rays is dealt none, and what is held back is not released twice") {
  Undealt undealt(1, no_bound);
  CHECK_THROWS_AS(undealt.take(0), core::InternalError);
  CHECK_THROWS_AS(undealt.release(), core::InternalError);
  CHECK_THROWS_AS(Undealt(1, 0), core::InternalError);
}

}  // namespace undealt_test
