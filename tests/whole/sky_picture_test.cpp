// A sky from a picture: one film by every strategy, on starved computers, under chaos, in virtual time and in several runs.
#include <doctest/doctest.h>

#include <cstdint>

#include "core/record/sky.h"
#include "nodes/chaos.h"
#include "tests/support/faceted_surfaces.h"
#include "tests/support/mesh_surfaces.h"
#include "tests/support/one_film.h"
#include "tests/support/scaled.h"
#include "tests/support/sky_pictures.h"
#include "tests/support/small_scenes.h"
#include "tests/support/subject.h"

namespace dmpc::tests::sky_picture_test {

namespace {

constexpr core::Transport below_sky{.kind = core::TransportKind::paths, .has_sky = true};

Subject::Size size_of(int bounces, int samples = 3) {
  return {.width = scaled_edge(22),
          .height = scaled_edge(18),
          .samples = samples,
          .knows_background = true,
          .transport = below_sky,
          .depth_max = bounces + 1};
}

core::Scene below_picture(core::Scene scene) {
  scene.sky = sunny_texels(60);
  return scene;
}

/// With textures, and with emitters for light sampling.
core::Scene much_of_all() {
  core::Scene scene = mirrors_and_glass();
  add_textured_walls(scene);
  core::SceneBuilder builder(scene);
  builder.material({.color = {0.1, 0.1, 0.1}, .emission = {3, 2, 1}});
  builder.sphere({0.5, 0.5, 2.2}, 0.2);
  builder.sphere({-0.5, 0.2, 2.0}, 0.1);
  return below_picture(scene);
}

core::BuildOptions options_of(std::size_t page_bytes, core::Structure structure = core::Structure::grid) {
  return {.page_size_bytes = page_bytes, .structure = structure, .emitters_max = 1024, .for_paths = true};
}

}  // namespace

TEST_CASE("below a sky's picture paths give one film by every strategy, with caches of one page, whatever else is there") {
  for (const core::Scene& scene : {much_of_all(), below_picture(mesh_surfaces()), below_picture(faceted_surfaces())}) {
    CAPTURE(scene.name);
    const Subject subject(scene, size_of(3), options_of(1024));
    REQUIRE(has_sky_picture(subject.settings().header));
    check_strategies(subject);
    for (const core::Structure structure : {core::Structure::extents, core::Structure::voxels}) {
      const Subject other(scene, size_of(3), options_of(512, structure));
      CHECK(other.outcome() == subject.outcome());
      CHECK(outcome_of(run_svm(other, {.computer = {.node_count = 3}, .pages = {.cache_pages = 1}})) == subject.outcome());
      CHECK(outcome_of(run_dataflow(other, {.computer = {.node_count = 3}})) == subject.outcome());
    }
    const Subject extents(scene, size_of(3), options_of(512, core::Structure::extents));
    for (const std::uint32_t nodes : {1U, 3U, 16U}) {
      CHECK(outcome_of(run_forest(extents, {.computer = {.node_count = nodes}})) == subject.outcome());
    }
  }
}

TEST_CASE("below a sky's picture paths give one film under chaos, and whatever is left out on the way" *
          doctest::test_suite("slow")) {
  const Subject subject(much_of_all(), size_of(2), options_of(512));
  for (std::uint64_t seed = 1; seed <= scaled(4); ++seed) {
    CAPTURE(seed);
    check_strategies(subject, nodes::chaos_of(seed));
  }
  check_skips(subject);
}

TEST_CASE("paths of 253 bounces below a sky's picture, and of none, give one film, as does one that nothing but the eye sees") {
  for (const int bounces : {0, 253}) {
    CAPTURE(bounces);
    check_strategies(Subject(below_picture(mesh_surfaces()), size_of(bounces), options_of(1024)));
  }
  core::Scene empty;
  empty.view = {.from = {0, 0, 0}, .at = {1, 0.2, 0}, .up = {0, 1, 0}, .angle_degrees = 90};
  const Subject subject(below_picture(empty), size_of(1), options_of(512));
  CHECK(subject.outcome().primary_hits == 0);
  check_strategies(subject);
}

TEST_CASE("on modelled machines, and with regions that move, a sky's picture makes one film") {
  const Subject subject(much_of_all(), size_of(2), options_of(1024));
  for (const std::uint32_t nodes : {2U, 8U}) {
    const nodes::ComputerRequest computer{.node_count = nodes, .machine = nodes::Machine{}};
    CHECK(outcome_of(run_svm(subject, {.computer = computer})) == subject.outcome());
    CHECK(outcome_of(run_dataflow(subject, {.computer = computer})) == subject.outcome());
    dataflow::RayOptions moving;
    moving.balance = {.balance = dataflow::Balance::moving, .regions_a_node = 4};
    CHECK(outcome_of(run_dataflow(subject, {.computer = computer, .rays = moving})) == subject.outcome());
    CHECK(outcome_of(run_dataflow(subject, {.computer = {.node_count = nodes}, .rays = moving})) == subject.outcome());
  }
}

TEST_CASE("a node by svm fetches of a large picture of the sky what its rays ask for, and no more") {
  core::Scene scene = mesh_surfaces();
  scene.sky = sunny_texels(700, 0);
  const Subject subject(scene, size_of(0, 1), options_of(1024));
  const std::size_t sky_pages = sky_tile_count(subject.settings().header.sky) / 4;
  const svm::Report report = run_svm(subject, {.computer = {.node_count = 16}});
  for (const auto& node : report.nodes) {
    CHECK(node.program.pages.faults < sky_pages / 4);
  }
}

}  // namespace dmpc::tests::sky_picture_test
