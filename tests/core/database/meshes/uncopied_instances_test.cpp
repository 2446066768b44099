// Scenes that leave copies out are built without any, and are what they are with all of them.
#include "core/database/meshes/uncopied_instances.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "apps/lab/bench/stability/random.h"
#include "apps/lab/bench/stability/rays.h"
#include "core/database/database.h"
#include "core/database/grid/macro_cells.h"
#include "core/record/emitter.h"
#include "core/record/records.h"
#include "core/scene/frame.h"
#include "core/scene/placed_objects.h"
#include "core/trace/instance_traversal.h"
#include "tests/support/base_mesh_scenes.h"
#include "tests/support/complaint.h"
#include "tests/support/film_of.h"
#include "tests/support/scaled.h"

namespace dmpc::tests::uncopied_instances_test {
namespace {

using apps::Random;
using core::BuildOptions;
using core::Copies;
using core::Database;
using core::Scene;
using core::Vec3d;

constexpr std::uint64_t none = 0, all = ~std::uint64_t{0};

Database built(Scene scene, const BuildOptions& options, std::uint64_t copies_max) {
  return core::build_database(std::move(scene), options, {.corners_max = copies_max});
}

/// Rugs that share planes with a floor, a lamp and a twin of a face, behind all places.
void add_own_things(Scene& scene) {
  add_rug(scene, false, 6);
  core::SceneBuilder builder(scene);
  builder.material({.emission = {3, 2, 1}});
  builder.polygon({{-0.5, -0.5, 1.5}, {0.5, -0.5, 1.5}, {0, 0.5, 1.5}});
  builder.material({.color = {0.2, 0.9, 0.3}, .diffuse = 0.7});
  for (int i = 0; i < 3; ++i) {
    builder.polygon({{-1, -1, 0.2}, {-0.8, -1, 0.2}, {-0.9, -0.7, 0.4}});
  }
}

Scene furnished(double size, Arrangement arrangement, std::uint64_t seed, Copies copies) {
  Scene scene = balls_in_places(size, arrangement, seed, copies);
  add_own_things(scene);
  return scene;
}

/// The ids and distances of what rays from all over meet.
std::vector<std::pair<std::uint32_t, float>> hits_of(const Database& database) {
  std::vector<std::pair<std::uint32_t, float>> hits;
  Random random(5);
  core::LocalRecords records(database.bytes());
  for (std::size_t i = 0; i < scaled(800); ++i) {
    const auto local = [&](const Vec3d& point) { return core::to_local(database.header().frame, point); };
    const core::Ray ray = apps::ray_through(local(random.in_box(-2, 2)), local(random.in_box(-0.6, 0.6) + Vec3d{0.1, 0.2, 0.5}));
    core::InstanceCursor cursor;
    core::Operations operations;
    core::trace(ray, cursor, records, database.header(), {}, operations);
    hits.emplace_back(cursor.best.primitive, cursor.best.t);
  }
  return hits;
}

std::uint64_t film(const Database& database, const core::View& view, core::TransportKind kind) {
  const int side = scaled_edge(24);
  return film_of(database, view,
                 {.transport = {.kind = kind, .has_sky = kind == core::TransportKind::paths},
                  .width = side,
                  .height = side,
                  .samples = 2,
                  .bounces = 3})
      .hash();
}

bool are_alike(const core::GridFrame& a, const core::GridFrame& b) {
  return a.origin == b.origin && a.scale == b.scale && a.low == b.low && a.resolution == b.resolution &&
         a.finest_cell == b.finest_cell && a.eye_extent == b.eye_extent;
}

/// The ids and chances of what paths aim at.
std::vector<std::pair<std::uint32_t, float>> emitters_of(const Database& database) {
  const core::LocalRecords records(database.bytes());
  std::vector<std::pair<std::uint32_t, float>> emitters;
  for (std::uint32_t i = 0; i < database.header().emitter_count; ++i) {
    const auto emitter = core::read<core::EmitterRecord>(records.find(core::emitter_address(database.header(), i)));
    emitters.emplace_back(emitter.primitive, emitter.chance);
  }
  return emitters;
}

void check_alike(const Database& light, const Database& whole) {
  CHECK(are_alike(light.header().frame, whole.header().frame));
  CHECK(light.pad() == whole.pad());
  CHECK(light.header().primitive_count == whole.header().primitive_count);
  CHECK(emitters_of(light) == emitters_of(whole));
  CHECK(light.header().directory_size == whole.header().directory_size);
  CHECK(light.records().instances == whole.records().instances);
  CHECK(light.records().triangles_in_places == whole.records().triangles_in_places);
  CHECK(light.records().normals == whole.records().normals);
  CHECK(light.duplicates() == whole.duplicates());
  CHECK(light.shared_planes() == whole.shared_planes());
  CHECK(light.dropped() == whole.dropped());
}

/// Triangles as long as the scene, so that macro cells have to become larger for their copies' sake.
Scene long_straws(Copies copies) {
  Scene scene = lit_scene();
  Random random(2);
  core::SceneBuilder builder(scene);
  builder.material({.diffuse = 0.8});
  for (int i = 0; i < 200; ++i) {
    const auto point = [&](double x) { return Vec3d(core::Vec3f(random.in_box(-1, 1) * 0.5 + Vec3d{x, 0, 0})); };
    const Vec3d from = point(-4);
    builder.polygon({from, point(4), Vec3d(core::Vec3f(from + Vec3d{0, 0, 0.01}))});
  }
  core::Instances instances{.meshes = {{0, 200}}};
  for (int i = 0; i < 40; ++i) {
    instances.places.push_back({turned_place(0.25, random.in_box(-0.3, 0.3), i % 3 == 0), 0, 200});
  }
  add_floor(scene, false);
  core::settle(scene, instances, copies);
  return scene;
}

}  // namespace

TEST_CASE("what is built without copies has the ids, the grid and the films of what is built with them") {
  std::uint64_t seed = 0;
  for (const double size : {0.4, 0.03, 1e-4}) {
    for (const Arrangement arrangement : {Arrangement::apart, Arrangement::deep_in_each_other, Arrangement::coincident}) {
      CAPTURE(++seed);
      const Scene left = furnished(size, arrangement, seed, Copies::left_out);
      BuildOptions options = with_instances();
      options.for_paths = seed % 3 == 0;
      options.emitters_max = options.for_paths ? 16 : 0;
      const Database light = built(left, options, none), whole = built(left, options, all);
      CHECK(light.records().instances == 18);
      CHECK(light.header().emitter_count == (options.for_paths ? 1 : 0));
      check_alike(light, whole);
      CHECK(hits_of(light) == hits_of(whole));
      const core::TransportKind kind = options.for_paths ? core::TransportKind::paths : core::TransportKind::whitted;
      CHECK(film(light, left.view, kind) == film(whole, left.view, kind));
    }
  }
}

TEST_CASE("only what is no copy is among the primitives of what was built without any") {
  const Scene left = furnished(0.3, Arrangement::apart, 1, Copies::left_out);
  const Database light = built(left, with_instances(), none);
  CHECK(light.primitives().size() == light.sources().size());
  CHECK(light.primitives().size() + light.records().triangles_in_places == light.header().primitive_count);
  for (const core::PrimitiveSource& source : light.sources()) {
    REQUIRE(source.object < left.objects.size());
  }
}

TEST_CASE("cells become as large for the sake of copies that are left out as for copies that are there") {
  BuildOptions options = with_instances();
  options.cells_per_primitive = 64;
  const Scene left = long_straws(Copies::left_out);
  const Database light = built(left, options, none), whole = built(left, options, all);
  REQUIRE(light.records().instances == 40);
  check_alike(light, whole);
  CHECK(hits_of(light) == hits_of(whole));
}

TEST_CASE("what copies that are left out would touch of cells is what copies touch that are there") {
  const core::Parallel parallel(2);
  for (const bool are_long : {true, false}) {
    const Scene left =
        are_long ? long_straws(Copies::left_out) : furnished(0.3, Arrangement::deep_in_each_other, 2, Copies::left_out);
    Scene whole = left;
    core::put_copies(whole);
    const auto faces = core::faces_of_meshes(left, 0.125, parallel);
    const core::UncopiedInstances places(left, faces, parallel);
    std::int64_t most = 0;
    for (const double cells : {0.125, 1.0, 64.0}) {
      const core::GridFrame frame = core::fit_frame(core::bounds_of(left, parallel), 8000, cells);
      const core::Conversion conversion = core::convert(whole, frame, parallel, {.meshes = faces});
      std::vector<core::PrimitiveValues> copies;
      for (std::size_t i = 0; i < conversion.primitives.size(); ++i) {
        if (core::place_of(whole, conversion.sources[i].object) != nullptr) {
          copies.push_back(conversion.primitives[i]);
        }
      }
      const double pad = core::insertion_pad(frame, 1);
      const std::uint64_t touches = core::MacroCells::touches_of(copies, frame, pad, all / 2);
      const std::int64_t expected = core::MacroCells::excess_of(touches, copies.size());
      constexpr std::uint64_t many = 1'000'000'000;  // so that nothing ends early
      CHECK(places.excess(frame, pad, many, true, parallel) == expected);
      CHECK(places.excess(frame, pad, many, false, parallel) >= expected);
      CHECK(places.excess(frame, pad, many, false, parallel) <= std::max<std::int64_t>(expected + 2 * copies.size(), 0));
      most = std::max(most, expected);
    }
    CHECK((most > 0) == are_long);
  }
}

TEST_CASE("where a mesh cannot be kept, copies are put in all the same") {
  const auto with_odd_corner = [](Copies copies) {
    Scene scene = rug_on_floor(true, true, 6);
    scene.vertices[0].x += 1e-12;  // which no float holds
    const auto count = static_cast<std::uint32_t>(scene.objects.size());
    core::Instances instances{.meshes = {{0, count}}};
    for (const double x : {-0.5, 0.5}) {
      instances.places.push_back({turned_place(0.3, {x, 0, 0}, false), 0, count});
    }
    core::settle(scene, instances, copies);
    return scene;
  };
  const Scene left = with_odd_corner(Copies::left_out);
  REQUIRE(leaves_copies_out(left));
  const Database light = built(left, with_instances(), none);
  CHECK(light.records().instances == 0);
  CHECK(hits_of(light) == hits_of(built(with_odd_corner(Copies::put), with_instances(), all)));
}

TEST_CASE("where no list has room for what copies touch, the look at them ends, and says so") {
  const core::Parallel parallel(2);
  const Scene left = long_straws(Copies::left_out);
  const auto faces = core::faces_of_meshes(left, 0.125, parallel);
  const core::UncopiedInstances places(left, faces, parallel);
  const core::GridFrame frame = core::fit_frame(core::bounds_of(left, parallel), 8000, 64);
  const double pad = core::insertion_pad(frame, 1);
  std::vector<core::PrimitiveValues> one(1);
  for (const bool is_exact : {false, true}) {
    const std::int64_t excess = places.excess(frame, pad, 1, is_exact, parallel);
    CHECK(excess >= std::int64_t{1} << 48U);
    CHECK_FALSE(core::MacroCells::list(one, frame, pad, parallel, excess));
  }
}

TEST_CASE("what has to have copies has them, and all else is kept, with the ids, the grid and the films of all copies") {
  const Scene left = with_obstacles(Copies::left_out);
  REQUIRE(left.kept->places.size() == 22);
  for (const bool for_paths : {false, true}) {
    BuildOptions options = with_instances();
    options.for_paths = for_paths;
    options.emitters_max = for_paths ? 400 : 0;
    const Database light = built(left, options, none), whole = built(left, options, all);
    CHECK(light.records().instances == 12);
    CHECK(light.records().base_meshes == 1);
    CHECK(light.records().copied == core::ObstacleCounts{{core::Obstacle::shining, 4},
                                                         {core::Obstacle::numbers, 4},
                                                         {core::Obstacle::far_away, 1},
                                                         {core::Obstacle::smallness, 1}});
    CHECK(light.records().copied == whole.records().copied);
    CHECK(light.header().emitter_count == (for_paths ? 4 * 72 : 0));
    CHECK(light.primitives().size() < whole.primitives().size());
    check_alike(light, whole);
    CHECK(hits_of(light) == hits_of(whole));
    const core::TransportKind kind = for_paths ? core::TransportKind::paths : core::TransportKind::whitted;
    BuildOptions copies = options;
    copies.keeps_instances = false;
    CHECK(film(light, left.view, kind) == film(whole, left.view, kind));
    CHECK(film(light, left.view, kind) == film(built(with_obstacles(Copies::put), copies, all), left.view, kind));
  }
}

TEST_CASE("copies that have to be there and have no room are an error that names them, and those that are kept need none") {
  const Scene left = with_obstacles(Copies::left_out);
  const auto complaint = [&left](std::uint64_t bytes) {
    return complaint_of<core::CapacityError>(
        [&] { core::build_database(Scene(left), with_instances(), {.corners_max = none, .bytes_max = bytes}); });
  };
  const std::uint64_t bytes_of_all = size_with_copies(left).bytes();
  CHECK(complaint(bytes_of_all / 2).empty());
  CHECK(complaint(0) ==
        "with a copy in each place of what cannot be kept once (mesh 1 of 3, which reaches too far out, in 1 place, mesh 2 of 3, "
        "which shines, in 4 places, mesh 3 of 3, which has numbers that no float holds, in 4 places), the scene takes 0 MiB of "
        "memory, and there are 0 for it: give the scene fewer places, or coarser meshes");
}

TEST_CASE("all copies that somebody wants and that have no room are an error that says why") {
  const Scene left = furnished(0.3, Arrangement::apart, 1, Copies::left_out);
  core::CopyLimits limits{.corners_max = all, .bytes_max = 0, .reason = "which are counted", .advice = "count less"};
  CHECK_THROWS_WITH_AS(core::build_database(Scene(left), with_instances(), limits),
                       "with a copy in each place, which are counted, the scene takes 0 MiB of memory, and there are 0 for it: "
                       "count less",
                       core::CapacityError);
}

TEST_CASE("where each primitive lies is known, also of what is kept") {
  const Database light = built(with_obstacles(Copies::left_out), with_instances(), none);
  const auto places = light.find_places();
  REQUIRE(places.size() == light.header().primitive_count);
  const auto known =
      std::count_if(places.begin(), places.end(), [](const Database::Place& place) { return place.leaf != core::no_address; });
  CHECK(static_cast<std::size_t>(known) == light.primitives().size() + light.records().triangles_in_places);
}

TEST_CASE("few copies are put in, so that all is said of them, and so are all that are to be expanded") {
  const Scene left = furnished(0.3, Arrangement::apart, 1, Copies::left_out);
  const std::uint64_t copies = object_count(left) - left.objects.size();
  std::uint64_t corners = 0;
  for (const core::BaseMeshInstance& place : left.kept->places) {
    corners += left.kept->meshes[place.mesh].vertices.size();
  }
  CHECK(built(left, with_instances(), corners).primitives().size() > left.objects.size() + copies);
  CHECK(built(left, with_instances(), corners - 1).primitives().size() < copies);
  CHECK(built(left, with_copies(), none).primitives().size() > left.objects.size() + copies);
}

}  // namespace dmpc::tests::uncopied_instances_test
