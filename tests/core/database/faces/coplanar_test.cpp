#include "core/database/faces/coplanar.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "apps/lab/bench/stability/random.h"
#include "apps/lab/bench/stability/rays.h"
#include "core/database/database.h"
#include "core/database/faces/plane_buckets.h"
#include "tests/support/covering_faces.h"
#include "tests/support/scaled.h"
#include "tests/support/shooting.h"
#include "tests/support/small_scenes.h"

namespace dmpc::tests::coplanar_test {
namespace {

using apps::Random;
using core::Database;
using core::Hit;
using core::Ray;
using core::Scene;
using core::SceneBuilder;
using core::Vec3d;

/// Rays that hit anything but certain objects, and those that hit something else than all triangles one by one would say.
struct Strays {
  int elsewhere = 0, from_brute_force = 0;
};

/// At a rectangle of the scene's plane, from both its sides. Of the objects from the first to the last one is to be hit.
Strays shoot_at(const Scene& scene, bool is_tilted, const Vec3d& low, const Vec3d& high, std::uint32_t first_object,
                std::uint32_t last_object) {
  const Database database = database_of(scene);
  const core::GridFrame& frame = database.header().frame;
  Random random(1);
  Strays strays;
  for (std::size_t i = 0; i < scaled(4000); ++i) {
    const Vec3d target = low + (high - low) * random.in_box(0, 1);
    Vec3d from = random.in_box(-3, 3);
    from.z += from.z < 0 ? -0.01 : 0.01;
    const auto place = [&](const Vec3d& at) { return core::to_local(frame, is_tilted ? tilted(at) : at); };
    const Ray ray = apps::ray_through(place(from), place(target));
    const Hit hit = apps::shoot(database, ray);
    const bool is_right = hit.found() && database.sources()[hit.primitive].object >= first_object &&
                          database.sources()[hit.primitive].object <= last_object;
    strays.elsewhere += is_right ? 0 : 1;
    strays.from_brute_force += apps::same_hit(hit, brute_force(database, ray)) ? 0 : 1;
  }
  return strays;
}

constexpr Vec3d rug_low{-0.99, -1.19, 0}, rug_high{1.09, 0.69, 0};

TEST_CASE("of two faces in one plane the first in the file shows, from both sides and at every angle") {
  for (const bool is_tilted : {false, true}) {
    CAPTURE(is_tilted);
    const Strays on_rug = shoot_at(rug_on_floor(is_tilted, true), is_tilted, rug_low, rug_high, 0, 1);
    CHECK(on_rug.elsewhere == 0);
    CHECK(on_rug.from_brute_force == 0);
    const Strays on_floor = shoot_at(rug_on_floor(is_tilted, false), is_tilted, rug_low, rug_high, 0, 0);
    CHECK(on_floor.elsewhere == 0);
    CHECK(on_floor.from_brute_force == 0);
  }
}

TEST_CASE("a rug of many triangles covers the floor without a gap") {
  for (const bool is_tilted : {false, true}) {
    CAPTURE(is_tilted);
    const Strays strays = shoot_at(rug_on_floor(is_tilted, true, 12), is_tilted, rug_low, rug_high, 0, 287);
    CHECK(strays.elsewhere == 0);
    CHECK(strays.from_brute_force == 0);
  }
}

TEST_CASE("the windings of faces in one plane do not matter") {
  Scene scene = lit_scene();
  SceneBuilder builder(scene);
  builder.polygon({tilted({-1, -1, 0}), tilted({1.2, -0.9, 0}), tilted({0.1, 1, 0})});
  builder.polygon({tilted({0.9, 1, 0}), tilted({1.5, -1.3, 0}), tilted({-1.6, -0.8, 0})});
  const Strays strays = shoot_at(scene, true, {-0.1, -0.5, 0}, {0.3, 0, 0}, 0, 0);
  CHECK(strays.elsewhere == 0);
  CHECK(database_of(scene).shared_planes() == 1);
}

TEST_CASE("what lets light through comes after what it lies on, wherever it stands in the file") {
  for (const bool is_tilted : {false, true}) {
    for (const bool glass_first : {false, true}) {
      CAPTURE(is_tilted);
      CAPTURE(glass_first);
      const Scene scene = glass_on_floor(is_tilted, glass_first);
      const std::uint32_t floor = glass_first ? 6 : 0;
      const Database database = database_of(scene);
      CHECK(database.shared_planes() == 1);
      const core::GridFrame& frame = database.header().frame;
      const auto place = [&](const Vec3d& at) { return core::to_local(frame, is_tilted ? tilted(at) : at); };
      for (const double z : {0.5, -0.5}) {
        const Hit hit = apps::shoot(database, apps::ray_through(place({0.1, 0.2, z}), place({0.12, 0.21, 0})));
        REQUIRE(hit.found());
        CHECK(database.sources()[hit.primitive].object == floor);
      }
    }
  }
}

TEST_CASE("what shines comes before what it lies on, wherever it stands in the file, and of twins it is the one that is kept") {
  for (const bool is_tilted : {false, true}) {
    for (const bool is_first : {false, true}) {
      CAPTURE(is_tilted);
      CAPTURE(is_first);
      Scene scene = lit_scene();
      SceneBuilder builder(scene);
      const auto quad = [&](double size, const Vec3d& emission) {
        builder.material({.emission = emission});
        const auto at = [&](double x, double y) { return is_tilted ? tilted({x, y, 0}) : Vec3d{x, y, 0}; };
        builder.polygon({at(-size, -size), at(size, -size), at(size, size), at(-size, size)});
      };
      quad(is_first ? 1.1 : 2, is_first ? Vec3d{1, 1, 1} : Vec3d{});
      quad(is_first ? 2 : 1.1, is_first ? Vec3d{} : Vec3d{1, 1, 1});
      const Strays strays = shoot_at(scene, is_tilted, {-1, -1, 0}, {1, 1, 0}, is_first ? 0 : 1, is_first ? 0 : 1);
      CHECK(strays.elsewhere == 0);
      CHECK(strays.from_brute_force == 0);
      quad(1.1, {});
      CHECK(database_of(scene).duplicates() == 2);
    }
  }
}

TEST_CASE("faces side by side share no plane, and nor does what is above another") {
  Scene scene = lit_scene();
  add_rug(scene, true, 16);
  CHECK(database_of(scene).shared_planes() == 0);
  Scene above = lit_scene();
  add_floor(above, false);
  SceneBuilder builder(above);
  builder.polygon(rectangle({-1, -1, 4e-6}, {1, 1, 0}, false));
  CHECK(database_of(above).shared_planes() == 0);
}

TEST_CASE("of the built-in scenes gears alone has faces that cover others: where teeth reach into each other") {
  for (const char* name :
       {"balls-2", "jacks-3", "lattice-4", "mount-6", "rings-3", "shells-2", "sombrero-1", "teapot-8", "tetra-6", "tree-6"}) {
    CAPTURE(std::string(name));
    const Database database = database_of(built_in(name));
    CHECK(database.shared_planes() == 0);
    CHECK(database.duplicates() == 0);
  }
  const Database gears = database_of(built_in("gears-2"));
  CHECK(gears.shared_planes() > 0);
  CHECK(gears.planes().empty());
  CHECK(gears.duplicates() == 0);
}

TEST_CASE("of triangles with the same corners the first is kept, the first that lets no light through if there is one") {
  const Vec3d a{0.1, 0.2, 0.3}, b{1.3, 0.1, 0.7}, c{0.4, 1.1, 0.9};
  Scene scene = lit_scene();
  SceneBuilder builder(scene);
  builder.material(glass_material);
  builder.polygon({a, b, c});
  builder.material(rug_material);
  builder.polygon({b, c, a});
  builder.polygon({c, b, a});
  builder.sphere({1, 1, 1}, 0.1);
  builder.patch({{2, 0, 0}, {2, 1, 0}, {2, 0, 1}}, {{1, 0, 0}, {1, 0.1, 0}, {1, 0, 0.1}});
  const Database database = database_of(scene);
  CHECK(database.duplicates() == 2);
  CHECK(database.shared_planes() == 0);
  REQUIRE(database.primitives().size() == 3);
  CHECK(database.sources()[0].object == 1);
  CHECK(database.sources()[1].object == 3);
  CHECK(database.sources()[2].object == 4);
  CHECK(database.records().normals == 1);
  CHECK(database.header().primitive_count == 3);
}

TEST_CASE("a sphere that is there twice is hit as the first") {
  Scene scene = lit_scene();
  SceneBuilder builder(scene);
  builder.sphere({0.3, 0.2, 0.7}, 0.7);
  builder.sphere({0.3, 0.2, 0.7}, 0.7);
  const Database database = database_of(scene);
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const Hit hit =
        apps::shoot(database, apps::ray_through(random.in_box(-1, 2), Vec3d{0.5, 0.5, 0.5} + random.in_box(-0.1, 0.1)));
    CHECK((!hit.found() || hit.primitive == 0));
  }
}

TEST_CASE("so many triangles that cover each other are built in time in proportion to them") {
  Random random(3);
  for (const bool is_tilted : {false, true}) {
    Scene scene = lit_scene();
    SceneBuilder builder(scene);
    const std::size_t count = scaled(20'000);  // as many pairs as would take a minute
    for (std::size_t i = 0; i < count; ++i) {
      std::vector<Vec3d> corners;
      for (int corner = 0; corner < 3; ++corner) {
        Vec3d at = random.in_box(-1, 1);
        at.z = 0;
        corners.push_back(is_tilted ? tilted(at) : at);
      }
      builder.polygon(corners);
    }
    const Database database = database_of(scene);
    CHECK(database.shared_planes() >= 1);
    CHECK(database.primitives().size() + database.dropped() == count);
    const core::GridFrame& frame = database.header().frame;
    for (int i = 0; i < 20; ++i) {
      Vec3d target = random.in_box(-0.5, 0.5);
      target.z = 0;
      const Ray ray =
          apps::ray_through(core::to_local(frame, {0.3, -0.4, 2.5}), core::to_local(frame, is_tilted ? tilted(target) : target));
      CHECK(apps::same_hit(apps::shoot(database, ray), brute_force(database, ray)));
    }
  }
}

TEST_CASE("the threads that build do not change what is shared") {
  const Scene scene = rug_on_floor(true, true, 30);
  const Database one = core::build_database(scene, {.threads = 1}), many = core::build_database(scene, {});
  CHECK(std::equal(one.bytes().begin(), one.bytes().end(), many.bytes().begin(), many.bytes().end()));
  CHECK(one.planes().size() == 1);
}

}  // namespace
TEST_CASE("faces that are together in several buckets are looked at in one of them") {
  const auto face = [](const Vec3d& shift, std::uint32_t id) {
    return core::Face({Vec3d{1, 0, 0} + shift, Vec3d{0, 1, 0} + shift, Vec3d{0, 0, 1} + shift}, {}, core::corner_rounding, id,
                      id);
  };
  const std::vector<core::Face> alike{face({}, 0), face({0.25, -0.25, 0}, 1)};  // they face three axes alike
  const core::PlaneBuckets buckets = core::fill_plane_buckets(alike);
  REQUIRE(buckets.buckets.size() == 1);
  CHECK(buckets.faces == std::vector<std::uint32_t>{0, 1});
  const std::vector<core::Face> apart{face({}, 0), face({0.25, 0.25, 0}, 1)};
  CHECK(core::fill_plane_buckets(apart).buckets.empty());
}

}  // namespace dmpc::tests::coplanar_test
