// Light along paths: one picture by every strategy, on starved computers, under chaos, in virtual time and in several runs.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <stop_token>

#include "core/picture/film/partial_picture.h"
#include "nodes/chaos.h"
#include "tests/support/faceted_surfaces.h"
#include "tests/support/mesh_surfaces.h"
#include "tests/support/one_film.h"
#include "tests/support/scaled.h"
#include "tests/support/small_scenes.h"
#include "tests/support/strategies.h"
#include "tests/support/subject.h"

namespace dmpc::tests::paths_picture_test {

namespace {

/// From the horizon to the zenith.
core::Transport under_sky() {
  return {.kind = core::TransportKind::paths, .has_sky = true, .has_gradient = true, .zenith = {0.1F, 0.3F, 2}, .up = {0, 0, 1}};
}

Subject::Size size_of(const core::Transport& transport, int bounces) {
  return {.width = scaled_edge(22),
          .height = scaled_edge(18),
          .samples = 3,
          .knows_background = true,
          .transport = transport,
          .depth_max = bounces + 1};
}

Subject::Size refined_size() {
  Subject::Size size = size_of(under_sky(), 2);
  size.samples = core::first_refined_samples(core::ErrorKind::noise);
  size.refinement = {.error = 4.0 / 255, .kind = core::ErrorKind::noise};
  return size;
}

core::Scene ball_in_the_air() {
  core::Scene scene;
  scene.background = {0.4, 0.5, 0.6};
  scene.view = {.from = {0, -6, 1}, .at = {0, 0, 0}, .up = {0, 0, 1}, .angle_degrees = 60};
  core::SceneBuilder builder(scene);
  builder.material({.color = {0.9, 0.8, 0.7}, .diffuse = 0.8, .specular = 0.2, .shine = 20});
  builder.sphere({0, 0, 0}, 1);
  return scene;
}

/// Lit by points and by a dozen emitters, of which triangles and spheres are used for light sampling: mirrors, glass and
/// textures, or microfacet surfaces.
core::Scene shining(bool is_faceted = false) {
  core::Scene scene = is_faceted ? faceted_surfaces() : mirrors_and_glass();
  if (!is_faceted) {
    add_textured_walls(scene);
  }
  core::SceneBuilder builder(scene);
  for (int i = 0; i < 6; ++i) {
    builder.material({.color = {0.1, 0.1, 0.1}, .emission = {1.0 + i, 2, 3.0 - 0.5 * i}});
    builder.sphere({-1.5 + 0.6 * i, 1.0 - 0.3 * i, 2.2}, 0.1 + 0.03 * i);
    builder.polygon({{-2.0 + 0.7 * i, -1, 1.5}, {-1.8 + 0.7 * i, -1, 1.5}, {-1.8 + 0.7 * i, -0.8, 1.7}});
  }
  return scene;
}

constexpr core::Transport indoors{.kind = core::TransportKind::paths};

}  // namespace

TEST_CASE("paths under a sky, with mirrors, glass, tiny mirrors, textures and what shines, give one picture by every strategy") {
  core::Scene textured = mirrors_and_glass();
  add_textured_walls(textured);
  for (const core::Scene& scene : {textured, mesh_surfaces(), faceted_surfaces()}) {
    CAPTURE(scene.name);
    const Subject subject(scene, size_of(under_sky(), 3), {.for_paths = true});
    REQUIRE(subject.outcome().rays[static_cast<std::size_t>(core::RayKind::scattered)] > 0);
    check_strategies(subject);
    const Subject extents(scene, size_of(under_sky(), 3),
                          {.page_size_bytes = 512, .structure = core::Structure::extents, .for_paths = true});
    CHECK(extents.outcome() == subject.outcome());
    for (const std::uint32_t nodes : {1U, 3U, 16U}) {
      CHECK(outcome_of(run_forest(extents, {.computer = {.node_count = nodes}})) == subject.outcome());
    }
  }
}

TEST_CASE("paths that aim at what shines give one picture by every strategy, whatever is left out on the way, under chaos" *
          doctest::test_suite("slow")) {
  for (const std::uint32_t emitters : {1U, 5U, 1024U}) {
    CAPTURE(emitters);
    const Subject subject(shining(), size_of(indoors, 3), {.page_size_bytes = 512, .emitters_max = emitters});
    REQUIRE(subject.settings().header.emitter_count == std::min(emitters, 12U));
    check_strategies(subject);
    const Subject extents(shining(), size_of(indoors, 3),
                          {.page_size_bytes = 512, .structure = core::Structure::extents, .emitters_max = emitters});
    CHECK(extents.outcome() == subject.outcome());
    CHECK(outcome_of(run_forest(extents, {.computer = {.node_count = 3}})) == subject.outcome());
  }
  const Subject faceted(shining(true), size_of(indoors, 3), {.emitters_max = 1024, .for_paths = true});
  CHECK(faceted.outcome().film_hash != Subject(shining(true), size_of(indoors, 3), {.for_paths = true}).outcome().film_hash);
  check_strategies(faceted);
  const Subject subject(shining(), size_of(under_sky(), 2), {.emitters_max = 1024});
  CHECK(subject.outcome().film_hash != Subject(shining(), size_of(under_sky(), 2)).outcome().film_hash);
  for (std::uint64_t seed = 1; seed <= scaled(4); ++seed) {
    check_strategies(subject, nodes::chaos_of(seed));
  }
  check_skips(subject);
}

TEST_CASE("a sky that changes is what each pixel where nothing is shows of it, though no ray is traced there") {
  for (const int samples : {1, 3}) {
    CAPTURE(samples);
    Subject::Size size = size_of(under_sky(), 1);
    size.samples = samples;
    const Subject subject(ball_in_the_air(), size);
    REQUIRE(subject.settings().background.count() > 0);
    check_strategies(subject);
    const Subject extents(ball_in_the_air(), size, {.page_size_bytes = 512, .structure = core::Structure::extents});
    CHECK(outcome_of(run_forest(extents, {.computer = {.node_count = 3}})) == subject.outcome());
  }
}

TEST_CASE("paths of 254 bounces, and of none, give one picture on stacks of one hit") {
  for (const int bounces : {0, 254}) {
    CAPTURE(bounces);
    check_strategies(Subject(mesh_surfaces(), size_of(under_sky(), bounces)));
  }
}

TEST_CASE("paths give one picture under chaos") {
  const Subject subject(mesh_surfaces(), size_of(under_sky(), 3));
  for (std::uint64_t seed = 1; seed <= scaled(8); ++seed) {
    CAPTURE(seed);
    check_strategies(subject, nodes::chaos_of(seed));
  }
}

TEST_CASE("paths give one picture whatever is left out on the way") {
  const Subject subject(mirrors_and_glass(), size_of(under_sky(), 2));
  check_skips(subject);
}

TEST_CASE("a picture by paths that was stopped goes on to the film of one run, by another strategy") {
  const Subject subject(shining(), size_of(under_sky(), 3), {.emitters_max = 1024});
  check_going_on(subject);
}

TEST_CASE("a picture by paths that is refined is one by every strategy, under chaos, too" * doctest::test_suite("slow")) {
  const Subject subject(mesh_surfaces(), refined_size());
  check_strategies(subject);
  check_strategies(subject, nodes::chaos_of(1));
  const Subject extents(mesh_surfaces(), refined_size(), {.page_size_bytes = 512, .structure = core::Structure::extents});
  CHECK(outcome_of(run_forest(extents, {.computer = {.node_count = 3}})) == extents.outcome());
}

TEST_CASE("a picture by paths that is refined goes on from any of its passes to the film of one run, with one estimate") {
  const Subject subject(mesh_surfaces(), refined_size());
  const core::RefinementResult whole = run_svm(subject, {.computer = {.node_count = 2}}).refinement;
  REQUIRE(whole.passes > 2);
  for (std::uint32_t passes = 1; passes <= whole.passes; ++passes) {
    CAPTURE(passes);
    std::optional<core::PartialPicture> kept;
    std::stop_source stop;
    const core::Continuation continuation{nullptr, [] { return true; },
                                          [&](const core::Film& film, const core::Refinement& pass, const core::PixelMask& done) {
                                            if (pass.result().passes == passes && !kept) {
                                              kept.emplace(core::partial_picture(film, pass, done));
                                              stop.request_stop();
                                            }
                                          }};
    svm::run_svm(subject.database(), subject.settings(), {.computer = {.node_count = 3}, .continuation = continuation},
                 stop.get_token());
    REQUIRE(kept);
    CHECK(core::fault_of(*kept, {.samples = 8, .refinement = subject.settings().refinement}) == nullptr);
    const core::Continuation rest{&*kept, [] { return false; }, {}};
    const auto by_pages = run_svm(subject, {.computer = {.node_count = 2}, .continuation = rest});
    CHECK(by_pages.film.hash() == subject.outcome().film_hash);
    CHECK(by_pages.refinement.error == whole.error);
    CHECK(run_dataflow(subject, {.computer = {.node_count = 2}, .continuation = rest}).film.hash() ==
          subject.outcome().film_hash);
  }
}

TEST_CASE("by paths a pixel under way takes the memory of one hit, whatever the bounces") {
  const auto stacks = [](const core::Transport& transport, int bounces) {
    const Subject subject(mirrors_and_glass(), size_of(transport, bounces));
    return run_svm(subject, {.computer = {.node_count = 1}, .pages = {.in_flight = 1}})
        .plan.node_memory(0)[core::MemoryUse::ray_stacks];
  };
  CHECK(stacks(under_sky(), 200) == stacks(under_sky(), 0));
  CHECK(stacks(under_sky(), 200) == stacks({}, 0));
  CHECK(stacks({}, 4) > stacks({}, 0));
}

}  // namespace dmpc::tests::paths_picture_test
