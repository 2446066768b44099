#include "core/scene/frame.h"

#include <doctest/doctest.h>

#include <cmath>

#include "apps/lab/bench/stability/random.h"

namespace frame_test {

using namespace dmpc::apps;
using namespace dmpc::core;
using dmpc::apps::Random;

namespace {

Box box_of(const Vec3d& low, const Vec3d& high) {
  Box box;
  box.include(low);
  box.include(high);
  return box;
}

double cells(const GridFrame& frame) {
  return static_cast<double>(frame.resolution[0]) * frame.resolution[1] * frame.resolution[2];
}

/// The box lies inside the grid, a margin from every side.
void check_covers(const GridFrame& frame, const Box& box) {
  const Vec3d low = to_local(frame, box.low) - frame.low, high = to_local(frame, box.high) - frame.low;
  const double cell = double{frame.finest_cell} * finest_per_cell;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    CHECK(low[axis] > 0.07 * cell);
    CHECK(high[axis] < (frame.resolution[axis] - 0.07) * cell);
  }
}

}  // namespace

TEST_CASE("a frame covers its bounds with about the wanted number of cells") {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Vec3d low = random.in_box(-100, 100);
    const Box box = box_of(low, low + random.in_box(0, 10));
    const std::size_t count = 1 + random.below(100'000);
    const GridFrame frame = fit_frame(box, count, 0.125);
    check_covers(frame, box);
    CHECK(cells(frame) <= 2 * std::max(1.0, 0.125 * static_cast<double>(count)) + 8);
  }
}

TEST_CASE("the scale is a power of two that brings the largest extent above 1/2 and to at most 1") {
  for (const double size : {1e-20, 0.3, 0.5, 1.0, 1.5, 3.0, 1e6, 1e20}) {
    const GridFrame frame = fit_frame(box_of({0, 0, 0}, {size, size / 2, size / 3}), 100, 0.125);
    int exponent = 0;
    CHECK(std::frexp(frame.scale, &exponent) == 0.5);
    CHECK(size * frame.scale >= 0.5);
    CHECK(size * frame.scale <= 1.0);
  }
}

TEST_CASE("a scene scaled by a power of two gets the same grid to the last bit") {
  Random random(3);
  for (int scene = 0; scene < 1000; ++scene) {
    const Vec3d low = random.in_box(-1, 1), size = random.in_box(0.001, 2);
    const std::size_t primitives = 1 + random.below(100'000);
    const GridFrame frame = fit_frame(box_of(low, low + size), primitives, 0.25);
    for (const int exponent : {-40, -13, -1, 1, 2, 40}) {
      const double factor = std::ldexp(1.0, exponent);
      const GridFrame scaled = fit_frame(box_of(low * factor, (low + size) * factor), primitives, 0.25);
      REQUIRE(scaled.resolution == frame.resolution);
      REQUIRE(scaled.finest_cell == frame.finest_cell);
      REQUIRE(scaled.scale * factor == frame.scale);
      REQUIRE(scaled.origin == frame.origin * factor);
      REQUIRE(scaled.low == frame.low);
    }
  }
}

TEST_CASE("flat, line-like and point-like scenes get a thickness") {
  for (const Vec3d& size : {Vec3d{1, 1, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 0}, Vec3d{1, 1e-9, 1}}) {
    const Box box = box_of({5, 6, 7}, Vec3d{5, 6, 7} + size);
    const GridFrame frame = fit_frame(box, 1000, 0.125);
    check_covers(frame, box);
    CHECK(cells(frame) <= 258);
    CHECK(frame.finest_cell > 0);
  }
}

TEST_CASE("a scene that is tiny for its distance gets as much room as rounding takes") {
  for (const double far : {1e5, 1e12, 6e27, 1e30}) {
    for (const double radius : {0.0, 1e-3, 0.37}) {
      for (const Vec3d& center : {Vec3d{0, 0, far}, Vec3d{-far, 0.5, 0.5}, Vec3d{far, far, -far}}) {
        const Vec3d half{radius, radius, radius};
        const GridFrame frame = fit_frame(box_of(center - half, center + half), 10, 0.125);
        const Vec3d local = to_local(frame, center) - frame.low, reach = half * frame.scale;
        check_covers(frame, {center, center});
        for (std::size_t axis = 0; axis < 3; ++axis) {
          CHECK(local[axis] - reach[axis] > 0);
          CHECK(local[axis] + reach[axis] < double{frame.finest_cell} * finest_per_cell * frame.resolution[axis]);
        }
      }
    }
  }
}

TEST_CASE("a scene smaller than any normal number is a point in a grid of normal ones") {
  for (const double size : {0x1p-1074, 1e-315, 1e-309, 0x1p-1001}) {
    CAPTURE(size);
    const Box box = box_of({0, -size, 0}, {size, size, size});
    const GridFrame frame = fit_frame(box, 8, 2.0);
    CHECK(std::isnormal(frame.scale));
    CHECK(std::isnormal(frame.finest_cell));
    CHECK(cells(frame) <= 64);
    check_covers(frame, box);
  }
}

TEST_CASE("no bounds give a frame of one cell") {
  const GridFrame frame = fit_frame({}, 0, 0.125);
  CHECK(cells(frame) == 1);
  CHECK(frame.finest_cell * finest_per_cell == 1.0F);
}

TEST_CASE("the insertion pad grows with the distance of the rays and never vanishes") {
  const GridFrame frame = fit_frame(box_of({0, 0, 0}, {1, 1, 1}), 1000, 0.125);
  CHECK(insertion_pad(frame, 0) >= 1e-3 * double{frame.finest_cell});
  CHECK(insertion_pad(frame, 1000) >= 1000 * 0x1p-21 * 0.5);
  CHECK(insertion_pad(frame, 1000) > insertion_pad(frame, 100));
}

TEST_CASE("the screen's axes are a right-handed frame with x to the right and y up") {
  const View view{.from = {0.3, -4, 2}, .at = {0, 0, 0.5}, .up = {0, 0, 1}};
  const std::array<Vec3d, 3> axes = screen_axes(view);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(dot(axes[i], axes[i]) == doctest::Approx(1));
    CHECK(std::fabs(dot(axes[i], axes[(i + 1) % 3])) < 1e-15);
  }
  CHECK(dot(cross(axes[0], axes[1]), axes[2]) == doctest::Approx(1));
  CHECK(dot(axes[1], view.up) > 0);
  CHECK(dot(axes[2], view.at - view.from) < 0);
}

}  // namespace frame_test
