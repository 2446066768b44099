// Faces that floats would make one: what the file's doubles tell apart stays apart.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "apps/lab/bench/stability/random.h"
#include "apps/lab/bench/stability/rays.h"
#include "core/database/database.h"
#include "core/picture/render.h"
#include "tests/support/covering_faces.h"
#include "tests/support/scaled.h"
#include "tests/support/shooting.h"
#include "tests/support/small_scenes.h"

namespace dmpc::tests::close_faces_test {
namespace {

using apps::Random;
using core::Database;
using core::Hit;
using core::Ray;
using core::Scene;
using core::SceneBuilder;
using core::Vec3d;

/// How things stand in a scene: a place, and directions at right angles, `out` of a wall.
struct Stand {
  Vec3d place, right, up, out;

  Vec3d at(double x, double y, double off) const { return place + right * x + up * y + out * off; }
};

constexpr Stand along_axes{{7300, 4100, 0}, {1, 0, 0}, {0, 0, 1}, {0, -1, 0}};
/// Turned about the vertical by an angle of sine 0.28: no coordinate is the same on all of the wall.
constexpr Stand turned_round{{7300, 4100, 0}, {0.96, 0.28, 0}, {0, 0, 1}, {0.28, -0.96, 0}};

/// A rectangle of a stand's, which leans: its upper edge is farther off by `leaning`.
std::vector<Vec3d> rectangle_of(const Stand& stand, const Vec3d& low, const Vec3d& high, double leaning = 0) {
  return {stand.at(low.x, low.y, low.z), stand.at(high.x, low.y, low.z), stand.at(high.x, high.y, low.z + leaning),
          stand.at(low.x, high.y, low.z + leaning)};
}

void add(SceneBuilder& builder, const std::vector<Vec3d>& corners, bool in_triangles) {
  if (!in_triangles) {
    builder.polygon(corners);
    return;
  }
  builder.polygon({corners[0], corners[1], corners[2]});
  builder.polygon({corners[0], corners[2], corners[3]});
}

constexpr double half_terrain = 10'000;

/// So many small things elsewhere that local zero does not lie at the wall.
void add_detail_elsewhere(SceneBuilder& builder) {
  Random random(7);
  for (const Vec3d& middle : {Vec3d{-7300, -4100, 0}, Vec3d{-7300, 4100, 0}, Vec3d{7300, -4100, 0}}) {
    for (int i = 0; i < 40; ++i) {
      builder.sphere(middle + random.in_box(-20, 20), 0.5);
    }
  }
}

/// A wall of 6 x 4 on a wide terrain, and `off` it a poster of 1 x 1.
Scene poster_scene(const Stand& stand, double off, double leaning, bool in_triangles, bool has_detail_elsewhere = true) {
  Scene scene = lit_scene();
  SceneBuilder builder(scene);
  builder.material(floor_material);
  builder.polygon({{-half_terrain, -half_terrain, 0},
                   {half_terrain, -half_terrain, 0},
                   {half_terrain, half_terrain, 0},
                   {-half_terrain, half_terrain, 0}});
  builder.polygon({{-half_terrain, -half_terrain, 0}, {-half_terrain, half_terrain, 0}, {-half_terrain, 0, 1000}});
  add(builder, rectangle_of(stand, {-3, 0, 0}, {3, 4, 0}), in_triangles);
  builder.material(rug_material);
  add(builder, rectangle_of(stand, {-0.5, 1, off}, {0.5, 2, off}, leaning), in_triangles);
  if (has_detail_elsewhere) {
    add_detail_elsewhere(builder);
  }
  scene.view = {.from = stand.at(0.4, 1.6, 3), .at = stand.at(0, 1.5, 0), .up = {0, 0, 1}, .angle_degrees = 45};
  return scene;
}

/// Rays towards the poster from before it and from behind, and those of them that are wrong: a ray that comes from the side where
/// the poster is hits that, another one the wall.
struct Wrong {
  int rays = 0, order = 0, from_brute_force = 0;
};

Wrong shoot_at_poster(const Stand& stand, double off, double leaning, bool in_triangles, bool has_detail_elsewhere = true) {
  const Database database = database_of(poster_scene(stand, off, leaning, in_triangles, has_detail_elsewhere));
  const std::uint32_t first_of_poster = in_triangles ? 4 : 3;
  Random random(1);
  Wrong wrong;
  for (std::size_t i = 0; i < scaled(500); ++i) {
    const Vec3d place = random.in_box(-0.45, 0.45), away = random.in_box(-1, 1);
    const double side = i % 2 == 0 ? 1 : -1, height = 1.5 + place.y;
    const Vec3d target = stand.at(place.x, height, off + leaning * (height - 1));
    const Vec3d from = stand.at(away.x, 1.5 + away.y, side * (1.5 + away.z));
    const auto local = [&](const Vec3d& at) { return core::to_local(database.header().frame, at); };
    const Ray ray = apps::ray_through(local(from), local(target));
    const Hit hit = apps::shoot(database, ray);
    const bool hits_poster = hit.found() && database.sources()[hit.primitive].object >= first_of_poster &&
                             database.sources()[hit.primitive].object < first_of_poster + 2;
    ++wrong.rays;
    wrong.order += hits_poster == (side * off > 0) ? 0 : 1;
    wrong.from_brute_force += apps::same_hit(hit, brute_force(database, ray)) ? 0 : 1;
  }
  return wrong;
}

TEST_CASE("a poster next to a wall in a wide terrain is seen from its side, and the wall from the other") {
  for (const Stand& stand : {along_axes, turned_round}) {
    for (const double off : {1e-3, -1e-3, 1e-4, 1e-6, 1e-8}) {
      for (const bool in_triangles : {false, true}) {
        CAPTURE(stand.out.x);
        CAPTURE(off);
        CAPTURE(in_triangles);
        for (const bool has_detail_elsewhere : {false, true}) {
          CAPTURE(has_detail_elsewhere);
          const Wrong wrong = shoot_at_poster(stand, off, 0, in_triangles, has_detail_elsewhere);
          CHECK(wrong.order == 0);
          CHECK(wrong.from_brute_force == 0);
        }
      }
    }
  }
}

TEST_CASE("a poster that leans against a wall is seen as one that does not") {
  for (const Stand& stand : {along_axes, turned_round}) {
    for (const double leaning : {1e-4, 1e-3, 1e-2}) {
      CAPTURE(stand.out.x);
      CAPTURE(leaning);
      const Wrong wrong = shoot_at_poster(stand, 1e-5, leaning, false);
      CHECK(wrong.order == 0);
      CHECK(wrong.from_brute_force == 0);
    }
  }
}

TEST_CASE("where doubles tell nothing apart records are as they were, and the first in the file shows") {
  const Database equal = database_of(poster_scene(along_axes, 0, 0, false)),
                 apart = database_of(poster_scene(along_axes, 1e-3, 0, false));
  CHECK(equal.planes().empty());
  CHECK(equal.shared_planes() == 1);
  CHECK(apart.planes().size() == 2);
  CHECK(apart.shared_planes() == 0);
  CHECK(shoot_at_poster(along_axes, 0, 0, false).order == 0);
}

/// A pane of glass, upright, tilted or not, between a checkered wall and the eye.
Scene pane_scene(double thickness, bool is_tilted) {
  Scene scene = lit_scene();
  SceneBuilder builder(scene);
  const auto turned = [&](std::vector<Vec3d> corners) {
    for (Vec3d& corner : corners) {
      corner = is_tilted ? tilted(corner) : corner;
    }
    return corners;
  };
  builder.material(floor_material);
  builder.polygon(turned({{-5, -5, -1.2}, {5, -5, -1.2}, {5, 5, -1.2}, {-5, 5, -1.2}}));
  builder.material(rug_material);
  for (int i = -2; i <= 2; ++i) {
    builder.sphere(turned({{double(i), 2, 0}})[0], 0.4);
  }
  builder.material(glass_material);
  const double front = -0.3, back = -0.3 + thickness;
  builder.polygon(turned({{-1.5, front, -1}, {1.5, front, -1}, {1.5, front, 1.4}, {-1.5, front, 1.4}}));
  builder.polygon(turned({{-1.5, back, -1}, {-1.5, back, 1.4}, {1.5, back, 1.4}, {1.5, back, -1}}));
  const std::vector<Vec3d> view = turned({{0.7, -6, 2}, {0, 0, 0}, {0, 0, 1}, {0, 0, 0}});
  scene.view = {.from = view[0], .at = view[1], .up = view[2] - view[3], .angle_degrees = 45};
  return scene;
}

core::Film rendered(const Scene& scene) {
  const Database database = database_of(scene);
  core::LocalRecords records(database.bytes());
  core::GridTracer<core::LocalRecords> tracer(records, database.header(), {});
  core::Operations operations;
  const core::RenderSettings settings{database.header(), core::Camera(scene.view, database.header().frame, 48, 48, 1), {}};
  return render(tracer, settings, operations);
}

/// Pixels that differ by more than a 100th.
int different_pixels(const core::Film& a, const core::Film& b) {
  int count = 0;
  for (std::uint32_t pixel = 0; pixel < 48 * 48; ++pixel) {
    const Vec3d off = a.radiance(pixel) - b.radiance(pixel);
    count += core::largest_component(off) > 0.01 ? 1 : 0;
  }
  return count;
}

TEST_CASE("a pane of glass bends light no more the thinner it is") {
  for (const bool is_tilted : {false, true}) {
    const core::Film thick = rendered(pane_scene(1e-4, is_tilted));
    for (const double thickness : {1e-5, 3e-6, 1e-6, 3e-7, 1e-7, 1e-8, 1e-9}) {
      CAPTURE(is_tilted);
      CAPTURE(thickness);
      CHECK(different_pixels(rendered(pane_scene(thickness, is_tilted)), thick) <= 2);
    }
  }
}

}  // namespace
}  // namespace dmpc::tests::close_faces_test
