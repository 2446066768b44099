// Faces that floats would make one: what the file's doubles tell apart stays apart.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "apps/lab/bench/stability/random.h"
#include "apps/lab/bench/stability/rays.h"
#include "core/database/database.h"
#include "core/database/faces/face_stack.h"
#include "core/picture/render.h"
#include "tests/support/close_faces.h"
#include "tests/support/film_of.h"
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
using core::Vec3d;

/// Rays towards the poster from before it and from behind, and those of them that are wrong: a ray that comes from the side where
/// the poster is hits that, another one the wall.
struct Wrong {
  int rays = 0, order = 0, from_brute_force = 0;
};

/// `share`: of the poster, from its lower edge on, at which rays are aimed.
Wrong shoot_at_poster(const Stand& stand, double off, double leaning, bool in_triangles, bool has_detail_elsewhere = true,
                      double share = 1) {
  const Database database = database_of(poster_scene(stand, off, leaning, in_triangles, has_detail_elsewhere));
  const std::uint32_t first_of_poster = in_triangles ? 4 : 3;
  Random random(1);
  Wrong wrong;
  for (std::size_t i = 0; i < scaled(500); ++i) {
    const Vec3d place = random.in_box(-0.45, 0.45), away = random.in_box(-1, 1);
    const double side = i % 2 == 0 ? 1 : -1, height = 1 + (0.5 + place.y) * share;
    const Vec3d target = stand.at(place.x, height, off + leaning * (height - 1));
    const Vec3d from = stand.at(away.x, 1.5 + away.y, side * (1.5 + away.z));
    const auto local = [&](const Vec3d& at) { return core::to_local(database.header().frame, at); };
    const Ray ray = apps::ray_through(local(from), local(target));
    const Hit hit = apps::shoot(database, ray);
    const bool hits_poster = hit.found() && database.sources()[hit.primitive].object >= first_of_poster &&
                             database.sources()[hit.primitive].object < first_of_poster + 2;
    ++wrong.rays;
    wrong.order += hits_poster == (side * (off + leaning) > 0) ? 0 : 1;
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

/// The stand above, scaled by a factor.
Stand grown(const Stand& stand, double times) { return {stand.place, stand.right * times, stand.up * times, stand.out * times}; }

TEST_CASE("a poster that is small beside its scene is seen from its side however much it leans, up to a quarter") {
  for (const double leaning : {3e-4, 3e-3, 3e-2, 0.1, 0.2}) {
    for (double away = 0; away < 8; ++away) {
      CAPTURE(leaning);
      CAPTURE(away);
      Stand stand = grown(turned_round, 0.25);
      stand.place = stand.place + Vec3d{1.7, 2.3, 0} * away;
      const Wrong wrong = shoot_at_poster(stand, 4e-5, leaning, false, true, 0.1);
      CHECK(wrong.order <= wrong.rays / 250);  // its edges are those of floats
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

TEST_CASE("a poster that touches its wall along its lower edge is before it, however the edge was rounded") {
  for (const Stand& stand : {along_axes, turned_round}) {
    const Wrong wrong = shoot_at_poster(stand, 0, 1e-4, false);
    CHECK(wrong.order <= wrong.rays / 100);  // next to the edge floats tell nothing
    CHECK(wrong.from_brute_force == 0);
  }
}

TEST_CASE("what a program's sines have left of a level of 0 is no other level") {
  const Database even = database_of(poster_scene(floor_of_all, 0, 0, false)),
                 rounded = database_of(poster_scene(floor_of_all, 1.2e-16, 0, false));
  CHECK(rounded.planes().size() == even.planes().size());
  CHECK(rounded.shared_planes() == even.shared_planes());
}

/// A floor that leans, with a rug in its plane, as a file of single precision has both.
Scene leaning_rug_in_floats() {
  Scene scene = lit_scene();
  core::SceneBuilder builder(scene);
  const auto add_in_floats = [&](const std::vector<Vec3d>& corners) {
    std::vector<Vec3d> rounded;
    for (const Vec3d& corner : corners) {
      const Vec3d at = tilted(corner);
      rounded.emplace_back(static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z));
    }
    builder.polygon(rounded);
  };
  builder.material(floor_material);
  add_in_floats({{-5, -5, -1}, {5, -5, -1}, {0, 5, -1}});
  builder.material(rug_material);
  add_in_floats({{-1.1, -1.3, -1}, {1.7, -1.2, -1}, {0.3, 1.9, -1}});
  scene.coordinate_rounding = 0x1p-25;
  return scene;
}

TEST_CASE("in a file of single precision faces that lean in one plane share it, whatever rounding did to their corners") {
  const Database database = database_of(leaning_rug_in_floats());
  CHECK(database.shared_planes() == 1);
  CHECK(database.planes().size() == 1);
}

TEST_CASE("faces that nobody had the time to look at lie in no order, and are said to") {
  std::vector<core::Face> faces;
  for (std::uint32_t i = 0; i < 5; ++i) {
    const double height = 0.25 + 1e-9 * i;
    faces.emplace_back(std::array<Vec3d, 3>{{{0, 0, height}, {0.5, 0, height}, {0, 0.5, height}}}, Vec3d(), 0x1p-49, i, i);
  }
  core::StackBudget ample, none{.pairs = 3};
  const core::FaceStack all = core::stack_faces(faces, ample), few = core::stack_faces(faces, none);
  CHECK(all.layers.size() == 5);
  CHECK(all.blurred.empty());
  CHECK(few.layers.size() == 5);
  CHECK(few.blurred.size() == 2);
  CHECK(none.pairs == 0);
}

core::Face exact_face(const std::array<Vec3d, 3>& corners, std::uint32_t id) { return {corners, Vec3d(), 0x1p-49, id, id}; }

/// The staves of a barrel, and a label around it, whose staves each lie on two of the barrel's. First those, then these; two
/// triangles each.
std::vector<core::Face> barrel_with_label(int staves) {
  const double radius = 0.4, angle = 2 * std::numbers::pi / staves, bulge = radius * angle * angle / 8;
  std::vector<core::Face> faces;
  const auto add_stave = [&](double first, double around, double half_height) {
    const auto at = [&](double place, double height) {
      return Vec3d{around * std::cos(place * angle), around * std::sin(place * angle), height};
    };
    const std::uint32_t id = static_cast<std::uint32_t>(faces.size());
    faces.push_back(exact_face({at(first, -half_height), at(first + 1, -half_height), at(first + 1, half_height)}, id));
    faces.push_back(exact_face({at(first, -half_height), at(first + 1, half_height), at(first, half_height)}, id));
  };
  for (int i = 0; i < staves; ++i) {
    add_stave(i, radius, 0.5);
  }
  for (int i = 0; i < staves; ++i) {
    add_stave(i + 0.5, radius + bulge + 1e-7, 0.2);
  }
  return faces;
}

TEST_CASE("a label that goes round a barrel is before it on all sides") {
  constexpr int staves = 512;
  const std::vector<core::Face> faces = barrel_with_label(staves);
  core::StackBudget budget;
  const core::FaceStack stack = core::stack_faces(faces, budget);
  CHECK(stack.blurred.empty());
  CHECK(stack.layers.size() == 2 * staves);
  int above = 0, outwards = 0;
  for (const core::FaceStack::Layer& layer : stack.layers) {
    above += layer.plane.stored_as == core::LeafHeader::exact_plane + (layer.ids[0] < 2 * staves ? 0 : 1) ? 1 : 0;
    outwards += dot(layer.plane.normal, faces[layer.ids[0]].middle()) > 0 ? 1 : 0;
  }
  CHECK(above == 2 * staves);
  CHECK(outwards == (outwards == 0 ? 0 : 2 * staves));
}

TEST_CASE("a face that is above another one here and below it there is said to be swapped with it, whatever layers they are in") {
  const std::vector<core::Face> faces{exact_face({{{-0.4, -0.4, 0}, {0.4, -0.4, 0}, {0, 0.4, 0}}}, 0),
                                      exact_face({{{-0.25, -0.1, 1e-9}, {-0.1, -0.1, 1e-9}, {-0.2, 0.1, 1e-9}}}, 1),
                                      exact_face({{{-0.2, -0.05, 3e-9}, {0.2, -0.05, -3e-9}, {-0.2, 0.05, 3e-9}}}, 2)};
  core::StackBudget budget;
  const core::FaceStack stack = core::stack_faces(faces, budget);
  REQUIRE(stack.blurred.size() == 1);
  CHECK(stack.blurred[0].layers == 2);
  CHECK(stack.blurred[0].least == 0);
  CHECK(double{stack.blurred[0].most} == doctest::Approx(3e-9));
}

/// A unit in the last place of a t from 4 to 8, grid-local.
constexpr double unit_of_t = 0x1p-21;

/// Eight squares above each other, which by their normals go up, so many units of t below a border between two macro cells; next
/// above the border is one that belongs to no others.
class Tower {
 public:
  explicit Tower(double units_below) {
    pile_up({.finest_cell = 0}, 0);  // the bounds and the number of primitives, hence the grid, will be the same
    pile_up(core::build_database(scene_, options()).header().frame, units_below);
  }

  const Scene& scene() const { return scene_; }
  static core::BuildOptions options() { return {.cells_per_primitive = 448}; }

 private:
  void pile_up(const core::GridFrame& frame, double units_below) {
    const auto above_border = [&](double units) {
      return frame.origin.z + (core::plane_at(frame, 2, core::finest_per_macro) + units * unit_of_t) / frame.scale;
    };
    scene_ = lit_scene();
    core::SceneBuilder builder(scene_);
    builder.material(floor_material);
    builder.polygon({{-1.1, -1.1, -1.1}, {-1, -1.1, -1.1}, {-1.1, -1, -1.1}});
    builder.polygon({{1.1, 1.1, 1.1}, {1, 1.1, 1.1}, {1.1, 1, 1.1}});
    const auto add_square = [&](double height) { builder.polygon(rectangle({-0.4, -0.4, height}, {0.4, 0.4, height}, false)); };
    for (int i = 1; i <= core::plane_layers_max; ++i) {
      add_square(above_border(-units_below) - 1e-9 * (core::plane_layers_max - i));
    }
    add_square(above_border(0.6));
    scene_ = apps::seen_from(scene_, 7);
  }

  Scene scene_;
};

TEST_CASE("a face that its layer brings before another one is found in whatever cell it lies, however far away the eye is") {
  for (double units_below = 4; units_below < 9; units_below += 0.125) {
    CAPTURE(units_below);
    const Database database = core::build_database(Tower(units_below).scene(), Tower::options());
    const core::GridFrame& frame = database.header().frame;
    const Vec3d middle = core::to_local(frame, {0.1, 0.05, 0});
    const Ray ray = apps::ray_through({middle.x, middle.y, core::plane_at(frame, 2, core::finest_per_macro) + 4.02}, middle);
    CHECK(apps::same_hit(apps::shoot(database, ray), brute_force(database, ray)));
  }
}

/// Seven sheets next to each other and, farther off than what is next to them, a square.
Scene sheets_and_square(double off, double side) {
  Scene scene = lit_scene();
  core::SceneBuilder builder(scene);
  builder.material(floor_material);
  builder.polygon({{-1.1, -1.1, -1.1}, {-1, -1.1, -1.1}, {-1.1, -1, -1.1}});
  builder.polygon({{1.1, 1.1, 1.1}, {1, 1.1, 1.1}, {1.1, 1, 1.1}});
  for (int i = 1; i < core::plane_layers_max; ++i) {
    builder.polygon(rectangle({-0.8, -0.8, -1e-9 * i}, {0.8, 0.8, -1e-9 * i}, true));
  }
  builder.material(rug_material);
  builder.polygon(rectangle({-side, -side, off}, {side, side, off}, true));
  return apps::seen_from(scene, 7);
}

TEST_CASE("a face that lies before a stack, though not next to it, is before all layers of it, from wherever it is seen") {
  for (const double off : {3e-7, 6e-7, 1.2e-6, 2.4e-6, 4.8e-6, 1e-5, 2e-5}) {
    for (const double side : {0.02, 0.1, 0.5}) {
      const Database database = database_of(sheets_and_square(off, side));
      const auto local = [&](const Vec3d& at) { return core::to_local(database.header().frame, tilted(at)); };
      for (const double away : {1.0, 4.0, 8.0, 14.0}) {
        CAPTURE(off);
        CAPTURE(side);
        CAPTURE(away);
        const Ray ray = apps::ray_through(local({0.3, -0.2, away}), local({0.01, 0.005, off}));
        const Hit hit = apps::shoot(database, ray);
        REQUIRE(hit.found());
        CHECK(database.sources()[hit.primitive].object == core::plane_layers_max + 1);
        CHECK(apps::same_hit(hit, brute_force(database, ray)));
      }
    }
  }
}

/// So many planes, each `step` above the last one, of so many triangles that lie across each other.
Scene heap(int planes, int triangles, double step) {
  Random random(5);
  Scene scene = lit_scene();
  core::SceneBuilder builder(scene);
  builder.material(floor_material);
  for (int plane = 0; plane < planes; ++plane) {
    for (int i = 0; i < triangles; ++i) {
      const Vec3d middle = random.in_box(-0.3, 0.3);
      std::vector<Vec3d> corners;
      for (int corner = 0; corner < 3; ++corner) {
        const double angle = middle.z * 10 + corner * 2 * std::numbers::pi / 3;
        corners.push_back(tilted({middle.x + std::cos(angle), middle.y + std::sin(angle), step * plane}));
      }
      builder.polygon(corners);
    }
  }
  return scene;
}

TEST_CASE("a poster next to its wall lies where doubles say even where a heap in the wall's plane leaves no time for pairs") {
  Scene scene = heap(1, 3000, 0);
  core::SceneBuilder builder(scene);
  builder.polygon(rectangle({3, 3, 0}, {5, 5, 0}, true));
  builder.polygon(rectangle({3.5, 3.5, 2e-6}, {4.5, 4.5, 2e-6}, true));
  const Database database = core::build_database(scene, {.cells_per_primitive = 1e-3});  // one macro cell
  const core::PrimitiveValues& poster = database.primitives().back();
  REQUIRE(poster.needs_plane());
  CHECK(core::LeafHeader{.plane = database.planes()[poster.plane() - 1].stored_as}.has_exact_plane());
}

TEST_CASE("where more planes lie next to each other than there is time for, the faces in them are said to be in no order") {
  CHECK(database_of(heap(60, 50, 1e-5)).close_faces().empty());
  CHECK(database_of(heap(150, 20, 1e-5)).close_faces().size() > 100);
}

core::Film rendered(const Scene& scene) {
  const Database database = database_of(scene);
  return film_of(database, {database.header(), core::Camera(scene.view, database.header().frame, 48, 48, 1), {}});
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

/// A pane across the diagonal of a scene, where coordinates are largest and add up in its planes, before rows of balls.
Scene pane_far_out(double thickness) {
  Scene scene = lit_scene();
  core::SceneBuilder builder(scene);
  const Vec3d out = Vec3d{1, 1, 1} * (1 / std::numbers::sqrt3), right = Vec3d{1, -1, 0} * (1 / std::numbers::sqrt2),
              up = Vec3d{-1, -1, 2} * (1 / std::sqrt(6.0)), middle{13, 13, 13};
  const auto at = [&](double x, double y, double off) { return middle + right * x + up * y + out * off; };
  builder.material(floor_material);
  builder.polygon({{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}});
  builder.polygon({{15.9, 15.9, 15.9}, {15.8, 15.9, 15.9}, {15.9, 15.8, 15.9}});
  builder.material(rug_material);
  for (int i = 0; i < 25; ++i) {
    builder.sphere(at(0.8 * (i % 5 - 2), 0.8 * (i / 5 - 2), -2), 0.3);
  }
  builder.material(glass_material);
  builder.polygon({at(-2, -2, 0), at(2, -2, 0), at(2, 2, 0), at(-2, 2, 0)});
  builder.polygon({at(-2, -2, -thickness), at(-2, 2, -thickness), at(2, 2, -thickness), at(2, -2, -thickness)});
  scene.view = {.from = at(3, 1, 6), .at = middle, .up = up, .angle_degrees = 45};
  scene.lights = {{at(4, 3, 8)}, {at(-5, 1, 9)}};
  return scene;
}

TEST_CASE("a pane so thin that rays which start on it pass its other side is said to be in no order, and no thicker one is") {
  const core::Film thick = rendered(pane_far_out(1e-4));
  for (double thickness = 0x1p-44; thickness < 0x1p-38; thickness *= std::sqrt(std::numbers::sqrt2)) {
    CAPTURE(std::log2(thickness));
    const Scene scene = pane_far_out(thickness);
    const bool is_said = !database_of(scene).close_faces().empty();
    const int wrong = different_pixels(rendered(scene), thick);
    CHECK((wrong <= 2 || is_said));
    CHECK((thickness < 0x1p-41 || !is_said));
  }
}

}  // namespace
}  // namespace dmpc::tests::close_faces_test
