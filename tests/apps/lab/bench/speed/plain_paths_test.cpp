// The plain path tracer of `bench speed`, and how ours is held against it.
#include <doctest/doctest.h>

#include <string>
#include <utility>
#include <vector>

#include "apps/lab/bench/speed/comparison.h"
#include "apps/lab/bench/speed/part.h"
#include "apps/lab/bench/speed/plain_renderer.h"
#include "core/base/expect.h"
#include "core/picture/render.h"
#include "tests/support/small_subject.h"

namespace dmpc::tests::plain_paths_test {

using apps::Comparison;
using apps::PathDistance;
using apps::PlainPicture;
using apps::PlainRenderer;

namespace {

apps::PictureOptions picture_by_paths(const std::string& scene, int bounces, bool has_sky) {
  apps::PictureOptions picture{.scene = scene, .resolution = apps::Resolution{24, 20}, .samples = 16};
  picture.transport = {.kind = core::TransportKind::paths, .bounces = bounces};
  if (has_sky) {
    picture.transport.sky = apps::SkyChoice{{1, 1, 1}, core::Vec3d{0.2, 0.4, 0.8}};
    picture.scene_setup.background = picture.transport.sky->horizon;
  }
  picture.depth = picture.transport.depth();
  return picture;
}

apps::Subject subject_by_paths(const std::string& scene, int bounces, bool has_sky, bool is_lit_and_polished = false) {
  const apps::PictureOptions picture = picture_by_paths(scene, bounces, has_sky);
  core::Scene loaded = apps::load_scene(picture);
  if (is_lit_and_polished) {
    apps::light_and_polish(loaded);
  }
  return apps::build_subject(std::move(loaded), picture);
}

/// A floor below a panel and two triangles that shine, with a rough ball, a smooth one, and one of tiny mirrors that lets
/// through.
core::Scene panels() {
  core::Scene scene;
  core::SceneBuilder builder(scene);
  builder.material({.color = {0.8, 0.7, 0.6}});
  builder.polygon({{-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0}});
  builder.material({.color = {0, 0, 0}, .diffuse = 0, .emission = {4, 5, 6}});
  builder.polygon({{-1, -1, 3}, {1, -1, 3}, {1, 1, 3}, {-1, 1, 3}});
  builder.material({.color = {0.2, 0.2, 0.2}, .emission = {9, 6, 3}});
  builder.polygon({{-2, -2, 1}, {-2, -1, 1}, {-2, -1, 2}});
  builder.material({.color = {1, 0.8, 0.3}, .microfacets = {.roughness = 0.6, .metallic = 1}});
  builder.sphere({-1, 0.5, 0.7}, 0.7);
  builder.material({.color = {0.3, 0.5, 0.9}, .microfacets = {.roughness = 0, .metallic = 0.1}});
  builder.sphere({1, 1, 0.6}, 0.6);
  builder.material({.refraction_index = 1.5, .microfacets = {.roughness = 0.3, .transmission = 0.8, .opacity = 0.9}});
  builder.sphere({0.4, -1, 0.5}, 0.5);
  builder.light({.position = {2, -3, 3}});
  scene.view = {.from = {1, -6, 3}, .at = {0, 0, 1}, .up = {0, 0, 1}, .angle_degrees = 40};
  return scene;
}

struct Compared {
  double ray_ratio;
  PathDistance distance;
};

core::Film film_of(const apps::Subject& subject, std::uint64_t& rays) {
  core::Operations operations;
  core::LocalRecords records(subject.database.bytes());
  core::GridTracer<core::LocalRecords> tracer(records, subject.settings.header, subject.settings.skips);
  core::Film film = core::render(tracer, subject.settings.with_every_ray_traced(), operations);
  rays = operations.ray_count();
  return film;
}

/// Throws if the pictures lie too far apart.
Compared compare(const apps::Subject& subject, const std::string& scene) {
  std::uint64_t rays = 0;
  const core::Film film = film_of(subject, rays);
  const PlainPicture picture = PlainRenderer(subject).render(1);
  return {static_cast<double>(picture.rays) / static_cast<double>(rays), apps::path_distance(picture, film, scene)};
}

}  // namespace

TEST_CASE("the plain path tracer goes our paths, to rounding: its rays are ours, and its picture lies within our noise") {
  // Flat and smooth triangles, mirrors, glass, spheres, cones.
  for (const char* scene : {"tetra-3", "teapot-3", "mount-4", "balls-2", "balls-2-t2", "rings-2", "tree-3"}) {
    for (const int bounces : {0, 1, 5}) {
      CAPTURE(std::string(scene));
      CAPTURE(bounces);
      const Compared compared = compare(subject_by_paths(scene, bounces, true), scene);
      CHECK(compared.ray_ratio == doctest::Approx(1).epsilon(0.02));
      CHECK(compared.distance.apart < apps::path_distance_max * compared.distance.noise);
    }
  }
}

TEST_CASE("the plain path tracer aims at what we aim at, and its tiny mirrors are ours") {
  for (const char* scene : {"tetra-3", "teapot-3", "mount-4", "balls-2", "rings-2"}) {
    for (const bool has_sky : {false, true}) {
      CAPTURE(std::string(scene));
      CAPTURE(has_sky);
      const apps::Subject subject = subject_by_paths(scene, 3, has_sky, true);
      REQUIRE(subject.settings.header.emitter_count > 0);
      CHECK(compare(subject, scene).ray_ratio == doctest::Approx(1).epsilon(0.02));
    }
  }
  for (const int bounces : {0, 1, 4}) {
    CAPTURE(bounces);
    const apps::PictureOptions picture = picture_by_paths("panels", bounces, false);
    const apps::Subject subject = apps::build_subject(panels(), picture);
    REQUIRE(subject.settings.header.emitter_count == 3);
    CHECK(compare(subject, "panels").ray_ratio == doctest::Approx(1).epsilon(0.02));
  }
}

TEST_CASE("without a sky the plain path tracer's eye and mirrors see the backdrop, and what it scatters does not") {
  CHECK_NOTHROW(compare(subject_by_paths("balls-2", 3, false), "balls-2"));
}

TEST_CASE("a path picture that is brighter than ours, or beyond our noise, is an error") {
  const apps::Subject subject = subject_by_paths("tetra-2", 2, true);
  std::uint64_t rays = 0;
  const core::Film film = film_of(subject, rays);
  PlainPicture picture = PlainRenderer(subject).render(1);
  CHECK_NOTHROW(apps::path_distance(picture, film, "tetra-2"));
  picture.pixels[7].y += 10;
  CHECK_THROWS_WITH_AS(apps::path_distance(picture, film, "tetra-2"),
                       doctest::Contains("the plain path tracer's picture of tetra-2 lies"), core::InternalError);
}

TEST_CASE("part paths holds ours against the plain path tracer on as many threads, by both clocks") {
  apps::SpeedSettings settings;
  settings.scenes = {"tetra-2"};
  settings.resolution = {16, 16};
  settings.rounds = 2;
  apps::Interrupt interrupt;
  std::vector<Comparison> results;
  apps::measure_paths(settings, interrupt, results);
  REQUIRE(results.size() == 2 * 6);
  CHECK(results[0].subject == "plain on 1 thread");
  CHECK(results[2].subject == "replicated on 1 node");
  CHECK(results[2].baseline == "plain on 1 thread");
  CHECK(results[3].subject == "svm on 2 nodes");
  CHECK(results[3].baseline == "plain on 2 threads");
  CHECK(results[3].figures.rounds() == 2);
  CHECK(results[3].processor.rounds() == 2);
  CHECK(results[4].what == "rays");
  CHECK(results[5].what == "distance");
  CHECK(results[6].scene == "tetra-2 with balls of light and metal");
}

}  // namespace dmpc::tests::plain_paths_test
