#include "apps/lab/check/inspection.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "apps/lab/bench/stability/cells.h"
#include "core/families/scenes.h"
#include "core/picture/render.h"
#include "core/record/records.h"
#include "tests/support/base_mesh_scenes.h"
#include "tests/support/close_faces.h"
#include "tests/support/scaled.h"

namespace dmpc::tests::inspection_test {
namespace {

/// A built-in scene, its database and how it is looked at: `side` x `side` pixels.
struct Looked {
  explicit Looked(const std::string& name, int side) : Looked(core::built_in_scene(core::parse_scene_name(name)), side) {}
  Looked(core::Scene looked_at, int side) : Looked(looked_at, side, apps::several_macro_cells(looked_at)) {}
  Looked(core::Scene looked_at, int side, const core::BuildOptions& build)
      : scene(std::move(looked_at)),
        database(core::build_database(scene, build)),
        settings{database.header(), core::Camera(scene.view, database.header().frame, side, side, 1), {}} {}

  apps::Inspection inspect(const apps::InspectionOptions& options = {}) const {
    const apps::EmbreeScene embree(database.primitives(), apps::EmbreeMode::robust);
    return apps::inspect(database, embree, settings, options);
  }

  core::Scene scene;
  core::Database database;
  core::RenderSettings settings;
};

std::uint64_t unexplained(const std::vector<apps::SettledRay>& rays) {
  std::uint64_t count = 0;
  for (const apps::SettledRay& ray : rays) {
    count += explained(ray.ruling.verdict) ? 0 : 1;
  }
  return count;
}

TEST_CASE("every ray of a small render of every family is explained") {
  for (const char* name : {"balls-2", "gears-2", "jacks-2", "lattice-3", "mount-4", "mount-3-t2", "rings-2", "rings-1-t1",
                           "shells-3", "sombrero-1", "teapot-4", "tetra-4", "tree-5"}) {
    CAPTURE(std::string(name));
    apps::InspectionOptions options;
    options.brute_force = 40;
    const apps::Inspection inspection = Looked(name, 48).inspect(options);
    CHECK(inspection.operations.rays[0] == 48 * 48);
    CHECK(unexplained(inspection.differences) == 0);
    CHECK(inspection.brute_forced.size() == 40);
    CHECK(unexplained(inspection.brute_forced) == 0);
  }
}

TEST_CASE("every ray is explained where faces lie so near to each other that doubles alone tell them apart") {
  for (const bool is_tilted : {false, true}) {
    for (const double off : {1e-3, -1e-3, 1e-7}) {
      CAPTURE(is_tilted);
      CAPTURE(off);
      const Looked poster(poster_scene(is_tilted ? turned_round : along_axes, off, 0, is_tilted), 48);
      CHECK(unexplained(poster.inspect({.brute_force = 200}).differences) == 0);
      CHECK(unexplained(poster.inspect({.brute_force = 200}).brute_forced) == 0);
      const Looked pane(pane_scene(std::fabs(off) * 1e-3, is_tilted), 32);
      CHECK(unexplained(pane.inspect().differences) == 0);
    }
  }
}

TEST_CASE("every ray that may go into base meshes is explained, by Embree among their copies and by every copy in double") {
  for (const Arrangement arrangement : {Arrangement::apart, Arrangement::deep_in_each_other}) {
    const Looked looked(balls_in_places(0.4, arrangement, 6), scaled_edge(48), with_instances());
    REQUIRE(looked.database.records().instances == 18);
    const apps::Inspection inspection = looked.inspect({.brute_force = 40});
    CHECK(inspection.operations.instance_entries > 0);
    CHECK(unexplained(inspection.differences) == 0);
    CHECK(unexplained(inspection.brute_forced) == 0);
  }
}

TEST_CASE("an oracle that lacks a triangle of one place is found out where the mesh is kept, in favour of the traversal") {
  const Looked looked(balls_in_places(0.4, Arrangement::apart, 6), 48, with_instances());
  std::vector<core::PrimitiveValues> without(looked.database.primitives().begin(), looked.database.primitives().end());
  const std::vector<core::Database::Place> places = looked.database.find_places();
  const apps::Referee referee(looked.database);
  std::uint32_t victim = core::no_primitive;
  for (std::uint32_t pixel = 0; victim == core::no_primitive && pixel < 48 * 48; pixel += 7) {
    const apps::Answer met = referee.exact(looked.settings.camera.primary_ray(pixel, 0));
    victim = met.hit && core::is_in_instance({.lane = places[met.primitive].lane}) ? met.primitive : victim;
  }
  REQUIRE(victim < without.size());
  without[victim] = {core::PrimitiveKind::sphere, {9, 9, 9, 0.001F}};
  const apps::Inspection inspection =
      apps::inspect(looked.database, apps::EmbreeScene(without, apps::EmbreeMode::robust), looked.settings, {});
  const auto in_favour = std::ranges::count_if(inspection.differences, [](const apps::SettledRay& difference) {
    return difference.ruling.verdict == apps::Verdict::oracle_wrong && difference.ruling.favours_grid;
  });
  CHECK(in_favour > 0);
  CHECK(unexplained(inspection.differences) == 0);
}

TEST_CASE("an inspection counts the pixels that the tracers render differently") {
  const Looked looked("rings-2", 96);
  const apps::EmbreeScene embree(looked.database.primitives(), apps::EmbreeMode::robust);
  core::LocalRecords records(looked.database.bytes());
  core::GridTracer<core::LocalRecords> grid(records, looked.database.header(), {});
  const auto places = looked.database.find_places();
  apps::EmbreeTracer oracle(embree, places, looked.database.header().frame, records);
  core::Operations operations;
  const core::Film ours = core::render(grid, looked.settings, operations),
                   theirs = core::render(oracle, looked.settings, operations);
  std::uint64_t differing = 0;
  for (std::uint32_t pixel = 0; pixel < ours.pixel_count(); ++pixel) {
    differing += ours.sums(pixel) == theirs.sums(pixel) ? 0 : 1;
  }
  CHECK(looked.inspect().differing_pixels == differing);
}

TEST_CASE("an inspection counts the rays that the reference renderer counts") {
  const Looked looked("mount-3", 40);
  core::LocalRecords records(looked.database.bytes());
  core::GridTracer<core::LocalRecords> tracer(records, looked.database.header(), {});
  core::Operations operations;
  core::render(tracer, looked.settings, operations);
  const core::Operations inspected = looked.inspect().operations;
  CHECK(inspected.rays == operations.rays);
  CHECK(inspected.shadow_blocked == operations.shadow_blocked);
  CHECK(inspected.primitive_tests == operations.primitive_tests);
}

TEST_CASE("an oracle that lacks a primitive is found out, in favour of the grid") {
  const Looked looked("teapot-4", 48);
  std::vector<core::PrimitiveValues> without(looked.database.primitives().begin(), looked.database.primitives().end());
  const core::Ray center = looked.settings.camera.primary_ray(24 * 48 + 24, 0);
  const std::uint32_t victim = apps::Referee(looked.database.primitives()).exact(center).primitive;
  REQUIRE(victim < without.size());
  without[victim] = {core::PrimitiveKind::sphere, {9, 9, 9, 0.001F}};
  const apps::EmbreeScene embree(without, apps::EmbreeMode::robust);
  const apps::Inspection inspection = apps::inspect(looked.database, embree, looked.settings, {});
  REQUIRE_FALSE(inspection.differences.empty());
  for (const apps::SettledRay& difference : inspection.differences) {
    CHECK(difference.ruling.verdict == apps::Verdict::oracle_wrong);
    CHECK(difference.ruling.favours_grid);
  }
}

TEST_CASE("the random rays are the same in every run and no more than there are") {
  const Looked looked("tetra-2", 16);
  apps::InspectionOptions options;
  options.brute_force = 25;
  const auto first = looked.inspect(options).brute_forced, second = looked.inspect(options).brute_forced;
  REQUIRE(first.size() == 25);
  for (std::size_t index = 0; index < first.size(); ++index) {
    CHECK(first[index].traced.ray.pixel == second[index].traced.ray.pixel);
    CHECK(first[index].traced.number == second[index].traced.number);
  }
  options.brute_force = 1000000;
  const apps::Inspection all = looked.inspect(options);
  CHECK(all.brute_forced.size() == all.operations.rays[0] + all.operations.rays[3]);
}

TEST_CASE("progress begins at nothing and ends with every pixel") {
  std::vector<std::uint64_t> done;
  apps::InspectionOptions options;
  options.progress = [&](std::uint64_t pixels, std::uint64_t total) {
    CHECK(total == 48 * 48);
    done.push_back(pixels);
  };
  Looked("tetra-1", 48).inspect(options);
  CHECK(done == std::vector<std::uint64_t>{0, 1024, 2048, 2304});
}

/// The picture with Embree naming the primitives.
core::Film render_by_embree(const Looked& looked, core::Operations& operations) {
  const apps::EmbreeScene embree(looked.database.primitives(), apps::EmbreeMode::robust);
  const auto places = looked.database.find_places();
  apps::EmbreeTracer tracer(embree, places, looked.database.header().frame, core::LocalRecords(looked.database.bytes()));
  return core::render(tracer, looked.settings, operations);
}

TEST_CASE("with Embree naming the primitives the picture of base meshes has the bits of their copies") {
  core::Scene ball = lit_scene();
  ball.textures = {leaves(16), leaves(9)};
  add_patched_ball(ball, 8);
  const core::Scene scene = placed(ball, {turned_place(0.4, {0.3, 0, 0.5}, false), turned_place(0.3, {-0.6, 0.4, 0.7}, true)});
  const int side = scaled_edge(48);
  const Looked kept(scene, side, with_instances()), copies(scene, side, with_copies());
  REQUIRE(kept.database.records().instances == 2);
  core::LocalRecords records(copies.database.bytes());
  core::GridTracer<core::LocalRecords> walk(records, copies.database.header(), {});
  core::Operations by_walk, by_embree;
  const std::uint64_t hash = core::render(walk, copies.settings, by_walk).hash();
  CHECK(render_by_embree(kept, by_embree).hash() == hash);
  CHECK(by_embree.rays == by_walk.rays);
}

TEST_CASE("where Embree names a triangle of a base mesh the hit is the traversal's, with its t, its leaf and its instance") {
  const Looked kept(balls_in_places(0.4, Arrangement::apart, 6), 48, with_instances());
  const apps::EmbreeScene embree(kept.database.primitives(), apps::EmbreeMode::robust);
  const auto places = kept.database.find_places();
  core::LocalRecords records(kept.database.bytes());
  apps::EmbreeTracer oracle(embree, places, kept.database.header().frame, records);
  core::GridTracer<core::LocalRecords> walk(records, kept.database.header(), {});
  core::Operations operations;
  std::uint32_t of_instances = 0, others = 0;
  for (std::uint32_t pixel = 0; pixel < 48 * 48; ++pixel) {
    const core::Ray ray = kept.settings.camera.primary_ray(pixel, 0);
    core::InstanceCursor named, walked;
    oracle.trace(ray, named, operations);
    walk.trace(ray, walked, operations);
    if (is_in_instance(named.best) && named.best.primitive == walked.best.primitive) {
      ++of_instances;
      others +=
          named.best.t == walked.best.t && named.best.leaf == walked.best.leaf && named.best.lane == walked.best.lane ? 0 : 1;
    }
  }
  CHECK(of_instances > 100);
  CHECK(others == 0);
}

TEST_CASE("with Embree naming the primitives the picture has the grid's bits") {
  for (const char* name : {"balls-2", "mount-3", "rings-2", "teapot-4", "tree-4", "shells-2"}) {
    CAPTURE(std::string(name));
    const Looked looked(name, 48);
    core::LocalRecords records(looked.database.bytes());
    core::GridTracer<core::LocalRecords> grid(records, looked.database.header(), {});
    core::Operations by_grid, by_embree;
    const std::uint64_t hash = core::render(grid, looked.settings, by_grid).hash();
    CHECK(render_by_embree(looked, by_embree).hash() == hash);
    CHECK(by_embree.rays == by_grid.rays);
    CHECK(by_embree.primitive_tests == std::array<std::uint64_t, core::primitive_kind_count>{});
  }
}

}  // namespace
}  // namespace dmpc::tests::inspection_test
