#include "apps/lab/oracle/reference/tracer.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "core/scene/scene.h"

namespace dmpc::tests::tracer_test {
namespace {

using apps::ReferenceRay;
using core::RayKind;
using core::Vec3d;
using doctest::Approx;

struct Log final : apps::RayWatcher {
  void shoot(ReferenceRay& ray) override { rays.push_back(ray); }
  std::vector<ReferenceRay> rays;
};

/// One ray from `origin` towards a place, with all that follows.
struct Shot {
  Shot(const core::Scene& scene, const Vec3d& origin, const Vec3d& at, const core::ShadeOptions& options = {}) {
    const apps::ReferenceScene reference = apps::reference_scene(scene);
    const apps::ReferenceFinder finder(reference, origin);
    apps::ReferenceTracer tracer(reference, finder, options, &log);
    radiance = tracer.radiance({.origin = origin, .direction = normalize(at - origin)});
    CHECK(tracer.rays() == log.rays.size());
  }
  Log log;
  Vec3d radiance;
};

/// A big square in z = 0, seen from above by its winding.
core::Scene plane_of(const core::Material& material) {
  core::Scene scene;
  scene.background = {0.25, 0.5, 1};
  core::SceneBuilder builder(scene);
  builder.material(material);
  builder.polygon({{-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}});
  return scene;
}

core::Scene ball_of(const core::Material& material) {
  core::Scene scene;
  scene.background = {0.25, 0.5, 1};
  core::SceneBuilder builder(scene);
  builder.material(material);
  builder.sphere({0, 0, 0}, 1);
  return scene;
}

const core::Material matt{.color = {1, 0.5, 0.25}, .diffuse = 0.5};
const core::Material mirror{.diffuse = 0, .specular = 0.5};
const core::Material glass{.diffuse = 0, .transmittance = 0.9, .refraction_index = 1.5};

TEST_CASE("a ray that meets nothing brings the background") {
  CHECK(Shot(ball_of(matt), {0, 0, 5}, {0, 5, 5}).radiance == Vec3d{0.25, 0.5, 1});
}

TEST_CASE("a matt plane shines by the cosine of its light") {
  core::Scene scene = plane_of(matt);
  scene.lights = {{{0, 3, 4}}};
  const Vec3d radiance = Shot(scene, {0, 0, 5}, {0, 0, 0}).radiance;
  CHECK(radiance.x == Approx(0.4).epsilon(1e-8));
  CHECK(radiance.y == Approx(0.2).epsilon(1e-8));
  CHECK(radiance.z == Approx(0.1).epsilon(1e-8));
}

TEST_CASE("a hidden light, and one behind the surface, bring nothing") {
  core::Scene scene = plane_of(matt);
  scene.lights = {{{0, 3, 4}}, {{0, 0, -3}}};
  core::SceneBuilder builder(scene);
  builder.sphere({0, 1.5, 2}, 0.25);
  const Shot shot(scene, {0.2, 0, 5}, {0, 0, 0});
  CHECK(shot.radiance == Vec3d{0, 0, 0});
  CHECK(shot.log.rays.size() == 2);
}

TEST_CASE("the paper's convention shoots at lights behind the surface, too, to no effect") {
  core::Scene scene = plane_of(matt);
  scene.lights = {{{0, 0, -3}}};
  const Shot shot(scene, {0, 0, 5}, {0, 0, 0}, {.convention = core::Convention::paper});
  CHECK(shot.radiance == Vec3d{0, 0, 0});
  CHECK(shot.log.rays.size() == 2);
}

TEST_CASE("a highlight is the cosine about the mirrored ray to the power of the shine") {
  core::Scene scene = plane_of({.diffuse = 0, .specular = 0.5, .shine = 3});
  scene.lights = {{{0, 3, 4}}};
  const Vec3d radiance = Shot(scene, {0, 0, 5}, {0, 0, 0}, {.depth_max = 1}).radiance;
  CHECK(radiance.x == Approx(0.5 * 0.8 * 0.8 * 0.8).epsilon(1e-8));
}

TEST_CASE("a mirror shows its share of the background") {
  CHECK(length(Shot(plane_of(mirror), {0, 1, 5}, {0, 0, 0}).radiance - Vec3d{0.125, 0.25, 0.5}) < 1e-15);
  CHECK(Shot(plane_of(mirror), {0, 1, 5}, {0, 0, 0}, {.depth_max = 1}).radiance == Vec3d{0, 0, 0});
}

TEST_CASE("glass bends a ray by Snell's law") {
  // Incidence at 30 degrees, sine 1/2, so the sine inside is 1/3.
  const Vec3d hit{0, 0.5, std::sqrt(0.75)};
  const Shot shot(ball_of(glass), {0, 0.5, 5}, hit);
  REQUIRE(shot.log.rays.size() > 1);
  const ReferenceRay& refracted = shot.log.rays[1];
  CHECK(refracted.kind == RayKind::refracted);
  CHECK(refracted.depth == 2);
  CHECK(length(cross(refracted.direction, hit)) == Approx(1.0 / 3).epsilon(1e-12));
  CHECK(dot(refracted.direction, hit) < 0);
  CHECK(refracted.weight.x == 0.9);
}

TEST_CASE("a ray leaves a glass ball at the angle it came in by") {
  const Shot shot(ball_of(glass), {0, 0.5, 5}, {0, 0.5, 0}, {.depth_max = 3});
  const ReferenceRay& out = shot.log.rays.back();
  CHECK(out.kind == RayKind::refracted);
  CHECK(out.depth == 3);
  CHECK(length(cross(out.direction, normalize(out.origin))) == Approx(0.5).epsilon(1e-8));
}

TEST_CASE("what neither mirrors nor lets light through sends out no ray but to lights, and to none that it cannot show") {
  core::Scene scene = plane_of(matt);
  scene.lights = {{{0, 3, 4}}, {{0, 3, 4}, {0, 0, 0}, true}};
  CHECK(Shot(scene, {0, 0, 5}, {0, 0, 0}).log.rays.size() == 2);
  CHECK(Shot(scene, {0, 0, 5}, {0, 0, 0}, {.convention = core::Convention::paper}).log.rays.size() == 3);
}

TEST_CASE("beyond the critical angle all is mirrored") {
  // From inside, along the normal's side, at 60 degrees: 1.5 sin 60 > 1.
  const Shot shot(plane_of(glass), {0, -std::sqrt(3.0), -1}, {0, 0, 0});
  REQUIRE(shot.log.rays.size() == 2);
  CHECK(shot.log.rays[1].kind == RayKind::reflected);
  CHECK(length(shot.radiance - Vec3d{0.225, 0.45, 0.9}) < 1e-12);
}

TEST_CASE("below the critical angle a leaving ray bends away from the normal") {
  const Shot shot(plane_of(glass), {0, -0.5, -std::sqrt(0.75)}, {0, 0, 0});
  REQUIRE(shot.log.rays.size() == 2);
  CHECK(shot.log.rays[1].direction.y == Approx(0.75).epsilon(1e-12));
}

TEST_CASE("in a uniform surrounding a perfect mirror and a perfectly clear ball cannot be seen") {
  const core::Material perfect{.diffuse = 0, .specular = 1}, clear{.diffuse = 0, .transmittance = 1, .refraction_index = 1};
  for (int step = 0; step < 20; ++step) {
    const Vec3d at{0.05 * step, 0.02 * step, 0};
    CHECK(length(Shot(ball_of(perfect), {0, 0, 5}, at).radiance - Vec3d{0.25, 0.5, 1}) < 1e-15);
    CHECK(length(Shot(ball_of(clear), {0, 0, 5}, at).radiance - Vec3d{0.25, 0.5, 1}) < 1e-15);
  }
}

TEST_CASE("rays come depth first and each hit's shadow rays before its children") {
  core::Scene scene = ball_of({.diffuse = 0.5, .specular = 0.2, .transmittance = 0.5, .refraction_index = 1.2});
  scene.lights = {{{0, 3, 4}}, {{1, 3, 4}}};
  const std::vector<ReferenceRay> rays = Shot(scene, {0, 0.1, 5}, {0, 0, 0}, {.depth_max = 2}).log.rays;
  REQUIRE(rays.size() == 7);
  CHECK(rays[1].kind == RayKind::shadow);
  CHECK(rays[1].light == 0);
  CHECK(rays[2].light == 1);
  CHECK(rays[3].kind == RayKind::reflected);
  CHECK(rays[4].kind == RayKind::refracted);
  CHECK(rays[4].depth == 2);
  CHECK(rays[5].kind == RayKind::shadow);
  CHECK(rays[5].depth == 2);
}

TEST_CASE("smooth normals blend between a triangle's corners") {
  core::Scene scene;
  scene.lights = {{{0, 0, 5}}};
  core::SceneBuilder builder(scene);
  builder.material({.color = {1, 1, 1}, .diffuse = 1});
  builder.patch({{-1, -1, 0}, {1, -1, 0}, {0, 2, 0}}, {{0, 0, 1}, {0, 0, 1}, {0, 3, 0}});
  // In the centroid: (0, 1/3, 2/3), so the cosine to the light above is 2 / sqrt 5.
  CHECK(Shot(scene, {0.1, 0, 5}, {0, 0, 0}).radiance.x == Approx(2 / std::sqrt(5.0)).epsilon(1e-8));
}

}  // namespace
}  // namespace dmpc::tests::tracer_test
