#include "core/picture/camera/background.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "apps/lab/bench/stability/cells.h"
#include "core/base/sampling.h"
#include "core/trace/traversal.h"
#include "tests/support/scaled.h"
#include "tests/support/small_scenes.h"

namespace picture_background_test {

using namespace dmpc::core;
using namespace dmpc::tests;

namespace {

/// A scene's database and how it is looked at.
struct Looked {
  Looked(const Scene& scene, int width, int height, int samples = 1)
      : Looked(build_database(scene, {}), scene.view, width, height, samples) {}
  Looked(Database from, const View& view, int width, int height, int samples)
      : database(std::move(from)), camera(view, database.header().frame, width, height, samples) {}

  bool hits(std::uint32_t pixel, std::uint32_t sample) const {
    LocalRecords records(database.bytes());
    Cursor cursor;
    Operations operations;
    return trace(camera.primary_ray(pixel, sample), cursor, records, database.header(), {}, operations) == Traced::hit;
  }
  BackgroundTiles tiles() const { return find_background(database, camera); }

  Database database;
  Camera camera;
};

std::uint32_t pixels_in(const BackgroundTiles& tiles, const Camera& camera) {
  std::uint32_t count = 0;
  for (std::uint32_t pixel = 0; pixel < camera.pixel_count(); ++pixel) {
    count += tiles.has(pixel) ? 1 : 0;
  }
  return count;
}

/// Pixels in empty tiles of which some sample hits something: there must be none.
std::uint32_t wrong_pixels(const Looked& looked) {
  const BackgroundTiles tiles = looked.tiles();
  std::uint32_t wrong = 0;
  for (std::uint32_t pixel = 0; pixel < looked.camera.pixel_count(); ++pixel) {
    for (std::uint32_t sample = 0; tiles.has(pixel) && sample < static_cast<std::uint32_t>(looked.camera.samples()); ++sample) {
      wrong += looked.hits(pixel, sample) ? 1 : 0;
    }
  }
  return wrong;
}

/// The share of empty tiles among those of which no ray through a pixel's middle hits anything.
double share_found(const Looked& looked) {
  const auto width = static_cast<std::uint32_t>(looked.camera.width()),
             height = static_cast<std::uint32_t>(looked.camera.height());
  std::vector<bool> is_hit(std::size_t{64} * 64);
  for (std::uint32_t pixel = 0; pixel < looked.camera.pixel_count(); ++pixel) {
    if (looked.hits(pixel, 0)) {
      is_hit[pixel / width * 64 / height * 64 + pixel % width * 64 / width] = true;
    }
  }
  return static_cast<double>(looked.tiles().count()) / static_cast<double>(std::count(is_hit.begin(), is_hit.end(), false));
}

double random(std::uint64_t number) { return static_cast<double>(mix(number) >> 11U) * 0x1p-53; }

Vec3d random_point(std::uint64_t number, double reach) {
  return {reach * (2 * random(3 * number) - 1), reach * (2 * random(3 * number + 1) - 1),
          reach * (2 * random(3 * number + 2) - 1)};
}

/// Looks at, past or away from a scene of that extent about a point, from within or from outside, widely or narrowly.
View random_view(std::uint64_t number, const Vec3d& about, double extent) {
  View view;
  view.from = about + random_point(4 * number, extent * (number % 3 == 0 ? 0.3 : 2));
  view.at = about + random_point(4 * number + 1, extent);
  view.up = random_point(4 * number + 2, 1);
  view.angle_degrees = number % 5 == 0 ? 150 : 1 + 80 * random(1000 + number);
  return view;
}

/// Grazes the plane through the scene's lowest points.
View grazing_view(const Vec3d& about, double extent) {
  return {.from = about + Vec3d{2 * extent, 0.1 * extent, 1e-4 * extent}, .at = about, .up = {0, 0, 1}, .angle_degrees = 30};
}

}  // namespace

TEST_CASE("no ray of an empty tile meets anything, wherever a scene is looked at from") {
  std::uint32_t found = 0;
  for (const char* name : {"balls-2", "gears-2", "jacks-2", "lattice-2", "mount-4", "mount-3-t2", "rings-2", "shells-2",
                           "sombrero-1", "teapot-4", "tetra-4", "tree-5"}) {
    CAPTURE(std::string(name));
    const Scene scene = built_in(name);
    Database database = build_database(scene, dmpc::apps::several_macro_cells(scene));
    const double extent = 0.5 / database.header().frame.scale;
    for (std::uint64_t number = 0; number < scaled(48); ++number) {
      CAPTURE(number);
      const View view = number == 1 ? grazing_view(scene.view.at, extent) : random_view(number, scene.view.at, extent);
      const Looked looked(std::move(database), number == 0 ? scene.view : view, 67, 43, 4);
      CHECK(wrong_pixels(looked) == 0);
      found += looked.tiles().count();
      database = looked.database;
    }
  }
  CHECK(found > scaled(48) * 2000);
}

TEST_CASE("where a scene leaves room most of it is found") {
  CHECK(share_found({built_in("tetra-6"), 256, 256}) > 0.9);
  CHECK(share_found({built_in("sombrero-2"), 256, 256}) > 0.9);
  CHECK(share_found({built_in("teapot-6"), 256, 256}) > 0.6);
  CHECK(share_found({built_in("mount-5"), 256, 256}) > 0.6);
  CHECK(share_found({built_in("shells-2"), 256, 256}) > 0.4);
}

TEST_CASE("a picture that a floor fills has no empty tile") {
  CHECK(Looked(built_in("balls-2"), 256, 256).tiles().count() == 0);
  CHECK(Looked(built_in("rings-2"), 256, 256).tiles().count() == 0);
}

TEST_CASE("a picture of nothing is all background") {
  CHECK(Looked(Scene(), 512, 300).tiles().count() == 4096);
  Scene scene = built_in("tetra-2");
  scene.view.at = scene.view.from * 2.0 - scene.view.at;
  const Looked away(scene, 100, 70);
  CHECK(away.tiles().count() == 4096);
  CHECK(pixels_in(away.tiles(), away.camera) == 7000);
}

TEST_CASE("tiles of one triangle are empty but for those around it") {
  Scene scene;
  SceneBuilder builder(scene);
  builder.polygon({{-0.1, -0.1, 0}, {0.1, -0.1, 0}, {-0.1, 0.1, 0}});
  scene.view = {.from = {0, 0, 1}, .at = {0, 0, 0}, .up = {0, 1, 0}, .angle_degrees = 90};
  const Looked looked(scene, 640, 640);
  const std::uint32_t occupied = 4096 - looked.tiles().count();
  CHECK(occupied >= 7 * 7);  // a tenth of the picture's sides, 6.4 tiles
  CHECK(occupied <= 9 * 9);
  CHECK(looked.tiles().has(0));
  CHECK_FALSE(looked.tiles().has(320 * 640 + 310));
}

TEST_CASE("an eye among things sees no background where they are") {
  Scene scene = built_in("lattice-3");
  scene.view.from = scene.view.from * 0.05 + scene.view.at * 0.95;
  CHECK(wrong_pixels({scene, 128, 128}) == 0);
  Scene room;
  SceneBuilder(room).sphere({0, 0, 0}, 1);
  room.view = {.from = {0.3, 0, 0}, .at = {1, 0, 0}, .up = {0, 0, 1}, .angle_degrees = 60};
  CHECK(Looked(room, 64, 64).tiles().count() == 0);
}

TEST_CASE("tiles fit pictures of one pixel, of as many as there are tiles, and of odd sizes") {
  for (const auto& [width, height] : {std::pair{1, 1}, {64, 64}, {65, 513}, {513, 65}, {3, 200}, {2, 1}}) {
    CAPTURE(width);
    CAPTURE(height);
    for (const char* name : {"tetra-3", "teapot-2"}) {
      CHECK(wrong_pixels({built_in(name), width, height, 3}) == 0);
    }
  }
  CHECK(Looked(built_in("tetra-3"), 65, 513).tiles().count() > 1000);
  CHECK(Looked(built_in("tetra-3"), 1, 1).tiles().count() == 0);
  CHECK(Looked(Scene(), 3, 200).tiles().count() == 3 * 64);
}

TEST_CASE("a rectangle is covered if each of its pixels is in an empty tile") {
  for (const int side : {5, 48, 64, 200}) {
    CAPTURE(side);
    const Looked looked(built_in("tetra-3"), side, side + 3);
    const BackgroundTiles tiles = looked.tiles();
    const auto width = static_cast<std::uint32_t>(side), height = width + 3;
    for (std::uint32_t i = 0; i < 2000; ++i) {
      const auto below = [&](std::uint32_t which, std::uint32_t end) {
        return static_cast<std::uint32_t>(mix(4 * i + which) % end);
      };
      const std::uint32_t x = below(0, width), y = below(1, height);
      const std::uint32_t wide = 1 + below(2, std::min(width - x, 9U)), high = 1 + below(3, std::min(height - y, 9U));
      bool all = true;
      for (std::uint32_t pixel = 0; pixel < wide * high; ++pixel) {
        all = all && tiles.has((y + pixel / wide) * width + x + pixel % wide);
      }
      REQUIRE(tiles.covers(x, y, wide, high) == all);
    }
  }
  CHECK_FALSE(BackgroundTiles().covers(0, 0, 1, 1));
}

TEST_CASE("no tile is empty by default or where a camera's angle leaves it open") {
  CHECK_FALSE(BackgroundTiles().has(0));
  CHECK_FALSE(BackgroundTiles().has(12345));
  Scene scene = built_in("tetra-2");
  scene.view.angle_degrees = 179.9999;
  CHECK(Looked(scene, 32, 32).tiles().count() == 0);
}

}  // namespace picture_background_test
