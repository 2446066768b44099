#include "dataflow/rays/pending_primaries.h"

#include <doctest/doctest.h>

#include <vector>

#include "core/base/expect.h"

namespace pending_primaries_test {

using namespace dmpc;
using core::PixelMask;
using dataflow::AssignedPrimaries;
using dataflow::PendingPrimaries;

namespace {

constexpr std::uint64_t no_bound = ~std::uint64_t{0};

/// All that may be assigned to a node now, ray by ray.
std::vector<std::uint64_t> rays_for(PendingPrimaries& pending_primaries, std::uint32_t node) {
  std::vector<std::uint64_t> rays;
  while (pending_primaries.has(node)) {
    const AssignedPrimaries packet = pending_primaries.take(node);
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

TEST_CASE("every ray is assigned once, to its node, in order") {
  PendingPrimaries pending_primaries(2, no_bound);
  CHECK(pending_primaries.is_empty());
  pending_primaries.begin_pass({{{0, 2}, {5, 1}}, {{2, 3}}}, {0, 1}, PixelMask(6));
  CHECK_FALSE(pending_primaries.is_empty());
  CHECK(rays_for(pending_primaries, 0) == Rays{0, 1, 5});
  CHECK(rays_for(pending_primaries, 1) == Rays{2, 3, 4});
  CHECK(pending_primaries.is_empty());
  CHECK(pending_primaries.begun() == PixelMask(6, true));
}

TEST_CASE("no run that is assigned is longer than the bound, and no packet has more runs than it has room for") {
  PendingPrimaries pending_primaries(1, 2);
  pending_primaries.begin_pass({{{0, 301}}}, {0, 1}, PixelMask(301));
  const AssignedPrimaries packet = pending_primaries.take(0);
  CHECK(packet.count == packet.runs.size());
  CHECK(packet.runs[1].first == 2);
  CHECK(packet.runs[1].count == 2);
  CHECK(rays_for(pending_primaries, 0).size() == 301 - 120);
}

TEST_CASE("a pass says which samples its rays are of") {
  PendingPrimaries pending_primaries(1, no_bound);
  pending_primaries.begin_pass({{{0, 4}}}, {2, 2}, PixelMask(2));
  CHECK(pending_primaries.take(0).samples == core::SampleRange{2, 2});
}

TEST_CASE("when rays are held back, pixels that have begun are assigned to the end and no other is begun") {
  PendingPrimaries pending_primaries(2, 3);
  pending_primaries.begin_pass({{{0, 80 * 3}}, {{240, 30}}}, {0, 3}, PixelMask(90));
  pending_primaries.take(0);  // 60 pixels
  pending_primaries.hold_back();
  CHECK(pending_primaries.holds_back());
  CHECK(pending_primaries.is_empty());
  CHECK(pending_primaries.begun().count() == 60);
  pending_primaries.release();
  CHECK_FALSE(pending_primaries.holds_back());
  CHECK(rays_for(pending_primaries, 0).front() == 180);
  CHECK(rays_for(pending_primaries, 1).size() == 30);
}

TEST_CASE("where places are in squares, the pixels that have begun are those of the places") {
  PendingPrimaries pending_primaries(1, 1, dataflow::PixelOrder::squares(20, 16));
  pending_primaries.begin_pass({{{0, 320}}}, {0, 1}, PixelMask(320));
  pending_primaries.take(0);  // 60 places: three squares, and three rows of the fourth
  for (std::uint32_t pixel = 0; pixel < 320; ++pixel) {
    const std::uint32_t x = pixel % 20, y = pixel / 20;
    CHECK(pending_primaries.begun().has(pixel) == (y < 4 && x < (y < 3 ? 16 : 12)));
  }
  pending_primaries.hold_back();
  CHECK(pending_primaries.begun().count() == 60);
  pending_primaries.release();
  CHECK(rays_for(pending_primaries, 0).front() == 60);
}

TEST_CASE("the other rays of a pixel that one node has begun are assigned to another") {
  PendingPrimaries pending_primaries(2, 1);
  pending_primaries.begin_pass({{{0, 1}, {2, 1}, {4, 1}}, {{1, 1}, {3, 1}, {5, 4}}}, {0, 2}, PixelMask(70));
  pending_primaries.take(0);  // a sample of each of the pixels 0, 1 and 2
  pending_primaries.hold_back();
  CHECK(rays_for(pending_primaries, 1) == Rays{1, 3, 5});
  CHECK(pending_primaries.is_empty());
  pending_primaries.release();
  CHECK(rays_for(pending_primaries, 1) == Rays{6, 7, 8});
}

TEST_CASE("where all pixels have begun nothing is held back") {
  PendingPrimaries pending_primaries(2, no_bound);
  pending_primaries.begin_pass({{{0, 1}}, {{1, 1}}}, {0, 2}, PixelMask(1));
  pending_primaries.take(0);
  pending_primaries.hold_back();
  CHECK_FALSE(pending_primaries.holds_back());
  CHECK(rays_for(pending_primaries, 1) == Rays{1});
}

TEST_CASE("pixels that were done before have begun") {
  PendingPrimaries pending_primaries(1, no_bound);
  PixelMask done(3);
  done.add(1);
  pending_primaries.begin_pass({{{0, 1}, {2, 1}}}, {0, 1}, done);
  CHECK(pending_primaries.begun() == done);
  pending_primaries.hold_back();
  CHECK(pending_primaries.holds_back());
}

TEST_CASE("a node without rays is assigned none, and what is held back is not released twice") {
  PendingPrimaries pending_primaries(1, no_bound);
  CHECK_THROWS_AS(pending_primaries.take(0), core::InternalError);
  CHECK_THROWS_AS(pending_primaries.release(), core::InternalError);
  CHECK_THROWS_AS(PendingPrimaries(1, 0), core::InternalError);
}

}  // namespace pending_primaries_test
