#include "core/picture/camera/tile_footprint.h"

#include <doctest/doctest.h>

#include <bit>
#include <limits>

#include "core/scene/frame.h"

namespace tile_footprint_test {

using namespace dmpc::core;

namespace {

/// Looks along -z from z = 1 with y up, through a frame that changes nothing. At z = 0 the picture's outermost pixels have their
/// middles at -1 and 1 along its shorter side.
const View wide_view{.from = {0, 0, 1}, .at = {0, 0, 0}, .up = {0, 1, 0}, .angle_degrees = 90};

constexpr std::uint64_t all_tiles = ~std::uint64_t{0};

Box box(const Vec3d& low, const Vec3d& high) { return {low, high}; }

/// Along one side from the middle of pixel `pixel` of 129 on: at z = 0, where a pixel is 1/64 wide.
double place(double pixel) { return pixel / 64 - 1; }

Camera camera_of(int width, int height, const View& view = wide_view) { return {view, {}, width, height, 1}; }

TileFootprint footprint_of(const Box& of, int width = 129, int height = 129) {
  return BoxProjector(camera_of(width, height)).footprint_of(of);
}

bool is_nothing(const TileFootprint& footprint) { return footprint.columns == 0 || footprint.rows == 0; }

}  // namespace

TEST_CASE("a box is seen in the columns and rows of tiles between its outermost corners") {
  const TileFootprint footprint = footprint_of(box({place(20), -place(40), 0}, {place(30), -place(36), 0}));
  CHECK(footprint.columns == 0x7f00U << 1U);  // pixels 18 to 31 of 129, of which 2 or 3 make a tile
  CHECK(footprint.rows == 0x1e0000U);         // pixels 35 to 41
}

TEST_CASE("a footprint reaches a pixel and a half beyond the box and no farther") {
  const TiledSide tiled = TiledSide::of(129);
  for (int pixel = 4; pixel < 120; ++pixel) {
    const auto columns = [&](double low, double high) {
      return footprint_of(box({place(low), 0, 0}, {place(high), 0, 0})).columns;
    };
    const std::uint64_t tile = std::uint64_t{1} << tiled.tile_of(static_cast<std::uint32_t>(pixel));
    CHECK((columns(pixel + 1.49, pixel + 3) & tile) != 0);
    CHECK((columns(pixel - 3, pixel - 1.49) & tile) != 0);
    const std::uint64_t before = std::uint64_t{1} << tiled.tile_of(static_cast<std::uint32_t>(pixel - 1));
    CHECK(((columns(pixel + 0.51, pixel + 3) & before) != 0) == (before == tile));
  }
}

TEST_CASE("a box behind the eye or beside the film is not seen") {
  CHECK(is_nothing(footprint_of(box({-1, -1, 1.5}, {1, 1, 2}))));
  CHECK(is_nothing(footprint_of(box({1.1, -1, 0}, {2, 1, 0}))));
  CHECK(is_nothing(footprint_of(box({-1, 1.1, 0}, {1, 2, 0}))));
}

TEST_CASE("a box around the eye is seen everywhere") {
  const TileFootprint footprint = footprint_of(box({-0.1, -0.1, 0.9}, {0.1, 0.1, 1.1}));
  CHECK(footprint.columns == all_tiles);
  CHECK(footprint.rows == all_tiles);
}

TEST_CASE("a box that reaches from ahead to behind the eye is seen from where it begins to the film's edge") {
  // A floor below the eye, seen from the middle of the picture down, where it comes towards the eye.
  const TileFootprint floor = footprint_of(box({-3, -0.5, -50}, {3, -0.4, 3}));
  CHECK(floor.columns == all_tiles);
  CHECK(floor.rows == all_tiles << 31U);
  // A wall to the right that begins at the depth 1.
  const TileFootprint wall = footprint_of(box({0.5, -9, 0}, {0.6, 9, 3}));
  CHECK(wall.rows == all_tiles);
  CHECK((wall.columns & all_tiles >> 18U) == 0);
  CHECK((wall.columns >> 50U) == all_tiles >> 50U);
}

TEST_CASE("a box beside the eye that reaches behind it may lie outside the picture") {
  CHECK(is_nothing(footprint_of(box({2, -0.1, 0.5}, {3, 0.1, 1.5}))));
}

TEST_CASE("a side of fewer pixels than tiles has a tile for each, one of more has them all") {
  for (const int pixels : {1, 2, 63, 64, 65, 513, 65536}) {
    CAPTURE(pixels);
    const TileFootprint all = BoxProjector(camera_of(pixels, 8)).all();
    CHECK(std::popcount(all.columns) == std::min(pixels, 64));
    CHECK(std::popcount(all.rows) == 8);
    const TiledSide side = TiledSide::of(pixels);
    CHECK(side.tile_of(0) == 0);
    CHECK(side.tile_of(static_cast<std::uint32_t>(pixels - 1)) < tiles_per_side);
  }
}

TEST_CASE("of a film that rounding could turn around nothing is said") {
  const auto is_certain = [](double angle, int side) {
    View view = wide_view;
    view.angle_degrees = angle;
    return BoxProjector(camera_of(side, side, view)).is_certain();
  };
  CHECK(is_certain(179.9, 65));
  CHECK_FALSE(is_certain(179.999, 65));
  CHECK_FALSE(is_certain(0, 65));
  CHECK(is_certain(1e-9, 65));
}

TEST_CASE("of an eye that is nowhere nothing is said") {
  View view = wide_view;
  view.from.x = std::numeric_limits<double>::infinity();
  CHECK_FALSE(BoxProjector(camera_of(8, 8, view)).is_certain());
}

TEST_CASE("where a pixel is smaller than what rounding does to a ray footprints reach far") {
  View view = wide_view;
  view.angle_degrees = 1e-7;  // a pixel is 2.7e-11 radians wide
  const TileFootprint footprint = BoxProjector(camera_of(65, 65, view)).footprint_of(box({-1e-12, -1e-12, 0}, {1e-12, 1e-12, 0}));
  CHECK(footprint.columns == all_tiles);
  CHECK(footprint.rows == all_tiles);
}

}  // namespace tile_footprint_test
