// Paths in double precision, with the product's random numbers: the same light except for rounding.
#include <doctest/doctest.h>

#include <cmath>

#include "apps/lab/oracle/reference/emitters.h"
#include "apps/lab/oracle/reference/picture.h"
#include "core/database/database.h"
#include "core/picture/render.h"
#include "core/record/records.h"
#include "tests/support/faceted_surfaces.h"
#include "tests/support/mesh_surfaces.h"
#include "tests/support/small_scenes.h"

namespace dmpc::tests::reference_paths_test {
namespace {

using core::Vec3d;

constexpr int side = 40;

/// A square picture with one sample a pixel, rendered by both.
struct Comparison {
  Comparison(const core::Scene& scene, const core::Transport& transport, int bounces, double tolerance,
             std::uint32_t emitters_max = 0) {
    const core::ShadeOptions shade{.depth_max = bounces + 1, .pixel_share = 1, .transport = transport};
    apps::ReferenceScene doubled = apps::reference_scene(scene);
    const core::Database database = core::build_database(scene, {.emitters_max = emitters_max, .for_paths = true});
    aim_as_product(doubled, database);
    const apps::ReferenceFinder finder(doubled, scene.view.from);
    const apps::ReferencePicture reference = render_accurately(doubled, finder, apps::ReferenceCamera(scene.view, side, side),
                                                               apps::SamplePattern::of_product(1), shade);
    const core::RenderSettings settings{database.header(), core::Camera(scene.view, database.header().frame, side, side, 1),
                                        shade};
    core::LocalRecords records(database.bytes());
    core::GridTracer tracer(records, settings.header, core::Skips{});
    core::Operations operations;
    const core::Film film = core::render(tracer, settings, operations);
    for (std::uint32_t pixel = 0; pixel < reference.radiance.size(); ++pixel) {
      note(film.radiance(pixel), reference.radiance[pixel], tolerance);
    }
    shadow_rays = operations.rays[static_cast<std::size_t>(core::RayKind::shadow)];
    paths_scattered = operations.rays[static_cast<std::size_t>(core::RayKind::scattered)];
  }
  double count() const { return side * side; }
  double mean_difference() const { return sum / count(); }
  double standard_error() const { return std::sqrt(squares / count() / count()); }

  int differing = 0;            ///< pixels with a channel that is off by more than the tolerance, or that share of it
  double sum = 0, squares = 0;  ///< differences of pixels, in all channels
  std::uint64_t paths_scattered = 0, shadow_rays = 0;

 private:
  void note(const Vec3d& product, const Vec3d& reference, double tolerance) {
    const Vec3d off = product - reference;
    differing += largest_component(off) > tolerance * std::max(1.0, largest_component(reference)) ? 1 : 0;
    sum += off.x + off.y + off.z;
    squares += (off.x + off.y + off.z) * (off.x + off.y + off.z);
  }
};

constexpr core::Transport sky{
    .kind = core::TransportKind::paths, .has_sky = true, .has_gradient = true, .zenith = {0.1F, 0.3F, 2}, .up = {0, 0, 1}};

core::Scene lit_by_eight(core::Scene scene, const core::Microfacets& facets = {}) {
  scene.lights.clear();
  core::SceneBuilder builder(scene);
  for (int i = 0; i < 4; ++i) {
    builder.material({.color = {0.5, 0.5, 0.5}, .emission = {2.0 + i, 3, 4}, .microfacets = facets});
    builder.sphere({-1 + 0.7 * i, 0.5, 1.1}, 0.1);
    builder.polygon({{-1 + 0.5 * i, -1, 1}, {-0.7 + 0.5 * i, -1, 1}, {-0.7 + 0.5 * i, -0.7, 1.3}});
  }
  return scene;
}

}  // namespace

TEST_CASE(
    "of paths of three bounces in double precision 99 of 100 bring the product's light, to 1e-5, the others no other mean") {
  core::Scene textured = mirrors_and_glass();
  add_textured_walls(textured);
  for (const core::Scene& scene : {built_in("tetra-5"), built_in("balls-2"), textured, mesh_surfaces(), faceted_surfaces()}) {
    for (const int bounces : {0, 1, 3}) {
      CAPTURE(scene.name);
      CAPTURE(bounces);
      const bool has_alpha = scene.name == "mesh surfaces" ||
                             scene.name == "faceted surfaces";  // which is looked up in single precision, and decides of ways
      const Comparison comparison(scene, sky, bounces, has_alpha ? 1e-4 : 1e-5);
      CHECK((bounces == 0 || comparison.paths_scattered > 200));
      CHECK(comparison.differing <= side * side / (has_alpha ? 50 : 100));
      CHECK(std::fabs(comparison.mean_difference()) <= 4 * comparison.standard_error() + 1e-6);
    }
  }
}

TEST_CASE("paths that aim at triangles and balls that shine bring the product's light in double precision, with its chances") {
  const core::Scene smooth = lit_by_eight(built_in("balls-2")), faceted = lit_by_eight(faceted_surfaces(), {.roughness = 0.5});
  for (const std::uint32_t emitters : {1U, 3U, 1024U}) {
    for (const int bounces : {0, 1, 3}) {
      CAPTURE(emitters);
      CAPTURE(bounces);
      for (const core::Scene& scene : {smooth, faceted}) {
        CAPTURE(scene.name);
        const Comparison comparison(scene, {.kind = core::TransportKind::paths}, bounces, 1e-4, emitters);
        CHECK(comparison.shadow_rays > 200);
        CHECK(comparison.differing <= side * side / 50);
        CHECK(std::fabs(comparison.mean_difference()) <= 4 * comparison.standard_error() + 1e-6);
      }
    }
  }
}

}  // namespace dmpc::tests::reference_paths_test
