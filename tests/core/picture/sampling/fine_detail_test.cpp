#include "core/picture/sampling/fine_detail.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "core/picture/sampling/sample_pair.h"
#include "tests/support/small_scenes.h"

namespace fine_detail_test {

using namespace dmpc::core;

namespace {

constexpr int side = 32;

/// Looks along -z at the origin from 10 away; a pixel is `pixel` wide there.
const double pixel = 2 * 10 * std::tan(0.5) / (side - 1);

struct Small {
  Small() : builder(scene) {
    scene.view = {.from = {0, 0, 10}, .at = {0, 0, 0}, .up = {0, 1, 0}, .angle_degrees = 1 / (3.14159265358979 / 180)};
    builder.light({.position = {5, 5, 10}});
  }
  FineDetail find() const {
    const Database database = build_database(scene, {});
    return find_fine_detail(database, Camera(scene.view, database.header().frame, side, side, 2));
  }
  static Vec3d place(double column, double row) {
    return {(column - 0.5 * (side - 1)) * pixel, (0.5 * (side - 1) - row) * pixel, 0};
  }

  Scene scene;
  SceneBuilder builder;
};

std::vector<std::uint32_t> pixels_of(const FineDetail& detail) {
  std::vector<std::uint32_t> pixels;
  for (std::uint32_t i = 0; i < side * side; ++i) {
    if (detail.has(i)) {
      pixels.push_back(i);
    }
  }
  return pixels;
}

}  // namespace

TEST_CASE("a sphere smaller than a pixel is detail of the pixels that it lies on, by the area that it covers") {
  Small small;
  small.builder.sphere(Small::place(7, 4), 0.2 * pixel);
  const FineDetail detail = small.find();
  REQUIRE(pixels_of(detail) == std::vector<std::uint32_t>{4 * side + 7});
  CHECK(detail.coverage(4 * side + 7) == doctest::Approx(3.1416 * 0.04).epsilon(0.02));
  CHECK(detail.variance(4 * side + 7) == doctest::Approx(0.1257 * (1 - 0.1257)).epsilon(0.02));
}

TEST_CASE("a sphere on a corner of pixels is detail of four") {
  Small small;
  small.builder.sphere(Small::place(7.5, 4.5), 0.2 * pixel);
  CHECK(pixels_of(small.find()) == std::vector<std::uint32_t>{4 * side + 7, 4 * side + 8, 5 * side + 7, 5 * side + 8});
}

TEST_CASE("a thin cone and a thin triangle are detail of all pixels on their way, and of no others") {
  for (const bool is_triangle : {false, true}) {
    CAPTURE(is_triangle);
    Small small;
    const Vec3d from = Small::place(3, 6), to = Small::place(20, 6), apex = Small::place(12, 6.1);
    is_triangle ? small.builder.polygon({from, to, apex}) : small.builder.cone(from, 0.05 * pixel, to, 0.05 * pixel);
    const FineDetail detail = small.find();
    double area = 0;
    for (const std::uint32_t i : pixels_of(detail)) {
      CHECK(i / side == 6);
      CHECK((i % side >= 3 && i % side <= 20));
      area += detail.variance(i) + detail.squares(i);
    }
    CHECK(pixels_of(detail).size() == 18);
    CHECK(area == doctest::Approx(is_triangle ? 17 * 0.1 / 2 : 17 * 0.1).epsilon(0.05));
  }
}

TEST_CASE("what is as wide as a pixel is no detail, nor what lies behind the eye or beside the picture") {
  Small small;
  small.builder.sphere(Small::place(7, 4), 0.6 * pixel);
  small.builder.sphere({0, 0, 20}, 0.2 * pixel);
  small.builder.sphere(Small::place(-20, 4), 0.2 * pixel);
  small.builder.polygon({{-3, -3, -1}, {3, -3, -1}, {0, 3, -1}});
  CHECK(pixels_of(small.find()).empty());
}

TEST_CASE("small things that fill a pixel crowd, and are no detail") {
  Small small;
  for (int i = 0; i < 30; ++i) {
    small.builder.sphere(Small::place(7 + 0.02 * (i % 6), 4 + 0.02 * (i % 5)), 0.2 * pixel);
  }
  CHECK(pixels_of(small.find()).empty());
}

TEST_CASE("detail does not depend on how the database is laid out") {
  Small small;
  for (int i = 0; i < 200; ++i) {
    const SamplePosition at = sample_position(17, static_cast<std::uint32_t>(i));
    small.builder.sphere(Small::place(at.x * side, at.y * side), 0.1 * pixel);
    small.builder.cone(Small::place(at.x * side, at.y * side), 0.02 * pixel, Small::place(at.y * side, 5), 0.01 * pixel);
  }
  const Database spatial = build_database(small.scene, {}),
                 scattered = build_database(small.scene, {.page_size_bytes = 4096, .record_order = RecordOrder::scattered});
  const Camera camera(small.scene.view, spatial.header().frame, side, side, 2);
  const FineDetail one = find_fine_detail(spatial, camera), other = find_fine_detail(scattered, camera);
  CHECK(pixels_of(one).size() > 100);
  CHECK(pixels_of(one) == pixels_of(other));
  for (const std::uint32_t i : pixels_of(one)) {
    CHECK(one.variance(i) == other.variance(i));
    CHECK(one.squares(i) == other.squares(i));
  }
}

TEST_CASE("nothing known has no detail, and a scene without any leaves nothing known") {
  CHECK(FineDetail().is_empty());
  CHECK_FALSE(FineDetail().has(5));
  Small small;
  small.builder.polygon({{-3, -3, -1}, {3, -3, -1}, {0, 3, -1}});
  CHECK(small.find().is_empty());
}

}  // namespace fine_detail_test
