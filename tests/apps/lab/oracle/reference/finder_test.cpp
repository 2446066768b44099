#include "apps/lab/oracle/reference/finder.h"

#include <doctest/doctest.h>

#include <string>

#include "core/base/sampling.h"
#include "tests/support/small_scenes.h"

namespace dmpc::tests::finder_test {
namespace {

using apps::ReferenceFinder;
using apps::ReferenceHit;
using apps::ReferenceRay;
using apps::ReferenceScene;
using core::Vec3d;

ReferenceHit brute_force(const ReferenceScene& scene, const ReferenceRay& ray) {
  ReferenceHit best;
  for (std::uint32_t body = 0; body < scene.bodies.size(); ++body) {
    const auto t = distance_to(scene.bodies[body], ray);
    if (t && *t < best.t && body != ray.ignored_body) {
      best = {*t, body};
    }
  }
  return best;
}

double random_share(std::uint32_t number, std::uint32_t dimension) {
  return static_cast<double>(core::mix(std::uint64_t{number} << 32U | (dimension + 1)) >> 11U) * 0x1p-53;
}

Vec3d random_place(const ReferenceScene& scene, std::uint32_t number, std::uint32_t dimension) {
  const Vec3d extent = scene.bounds.high - scene.bounds.low;
  return scene.bounds.low + extent * Vec3d{random_share(number, dimension), random_share(number, dimension + 1),
                                           random_share(number, dimension + 2)};
}

/// From places in the scene's box, or from the eye, to places in it.
ReferenceRay random_ray(const ReferenceScene& scene, const Vec3d& eye, std::uint32_t number) {
  ReferenceRay ray;
  ray.origin = number % 2 == 0 ? eye : random_place(scene, number, 0);
  // Every other pair aims at a corner or an end of a body, where a box that float has moved would be passed by.
  const auto body = static_cast<std::size_t>(random_share(number, 6) * static_cast<double>(scene.bodies.size()));
  const Vec3d target = number / 2 % 2 == 0 ? scene.bodies[body].place[0] : random_place(scene, number, 3);
  ray.direction = normalize(target - ray.origin);
  return ray;
}

void check_against_brute_force(const core::Scene& scene, const Vec3d& eye) {
  const ReferenceScene reference = apps::reference_scene(scene);
  const ReferenceFinder finder(reference, eye);
  int hits = 0;
  for (std::uint32_t number = 0; number < 500; ++number) {
    ReferenceRay ray = random_ray(reference, eye, number);
    const ReferenceHit expected = brute_force(reference, ray), found = finder.closest(ray);
    REQUIRE(found.body == expected.body);
    REQUIRE(found.t == expected.t);
    REQUIRE(finder.any(ray).found() == expected.found());
    ray.t_max = expected.t;
    REQUIRE(finder.closest(ray).t >= expected.t);
    hits += expected.found() ? 1 : 0;
  }
  CHECK(hits > 100);
}

core::Scene moved(core::Scene scene, double scale, const Vec3d& offset) {
  const auto move = [&](Vec3d& place) { place = place * scale + offset; };
  for (Vec3d& vertex : scene.vertices) {
    move(vertex);
  }
  for (core::Sphere& sphere : scene.spheres) {
    move(sphere.center);
    sphere.radius *= scale;
  }
  for (core::Cone& cone : scene.cones) {
    move(cone.base), move(cone.apex);
    cone.base_radius *= scale, cone.apex_radius *= scale;
  }
  move(scene.view.from);
  return scene;
}

TEST_CASE("the finder finds what brute force finds") {
  for (const char* name : {"tetra-3", "rings-1", "mount-3", "tree-4"}) {
    CAPTURE(std::string(name));
    const core::Scene scene = built_in(name);
    check_against_brute_force(scene, scene.view.from);
  }
  check_against_brute_force(mirrors_and_glass(), {0.3, -4, 2});
}

TEST_CASE("the finder finds it at any scale, place and distance of the eye") {
  const core::Scene scene = mirrors_and_glass();
  for (const double scale : {1e-6, 1e6}) {
    const core::Scene scaled = moved(scene, scale, {});
    check_against_brute_force(scaled, scaled.view.from);
  }
  const core::Scene far = moved(scene, 1, {1e6, -2e6, 3e6});
  check_against_brute_force(far, far.view.from);
  check_against_brute_force(scene, {0.3, -4000, 2});
}

TEST_CASE("of equal distances the lower body wins") {
  core::Scene scene;
  core::SceneBuilder builder(scene);
  for (int copy = 0; copy < 20; ++copy) {
    builder.polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  }
  const ReferenceScene reference = apps::reference_scene(scene);
  const ReferenceFinder finder(reference, {0, 0, 1});
  ReferenceRay ray{.origin = {0.2, 0.2, 1}, .direction = {0, 0, -1}};
  CHECK(finder.closest(ray).body == 0);
  ray.ignored_body = 0;
  CHECK(finder.closest(ray).body == 1);
}

TEST_CASE("faces that doubles tell apart are two, however wide the scene is, and the nearer one shows") {
  core::Scene scene;
  core::SceneBuilder builder(scene);
  builder.polygon({{-1e4, -1e4, 0}, {1e4, -1e4, 0}, {0, 1e4, 0}});
  for (const double off : {1e-3, 1e-9, -1e-9, 1e-3}) {
    builder.polygon({{-1, -1, off}, {1, -1, off}, {0, 1, off}});
  }
  const ReferenceScene reference = apps::reference_scene(scene);
  const ReferenceFinder finder(reference, {0, 0, 5});
  ReferenceRay ray{.origin = {0.01, 0.02, 5}, .direction = normalize(Vec3d{0, 0.1, -1})};
  CHECK(finder.closest(ray).body == 1);
  ray.origin.z = -5, ray.direction.z *= -1;
  CHECK(finder.closest(ray).body == 3);
}

TEST_CASE("a ray that starts on a face meets what lies a hair before it, and nothing that lies in its plane") {
  core::Scene scene;
  core::SceneBuilder builder(scene);
  for (const double height : {0.3, 0.3, 0.300001}) {
    builder.polygon({{-1.5, -1, height}, {1.5, -1, height}, {0, 1.4, height}});
  }
  const ReferenceScene reference = apps::reference_scene(scene);
  const ReferenceFinder finder(reference, {0, 0, 5});
  const ReferenceRay ray{.origin = {0.1, 0.2, 0.3 + 1e-13}, .direction = {0, 0, 1}, .ignored_body = 0};
  CHECK(finder.closest(ray).body == 2);
  CHECK(finder.closest(ray).t == doctest::Approx(1e-6).epsilon(1e-5));
}

TEST_CASE("a ray ignores the triangle it starts on and no sphere") {
  core::Scene scene;
  core::SceneBuilder builder(scene);
  builder.sphere({0, 0, 0}, 1);
  const ReferenceScene reference = apps::reference_scene(scene);
  const ReferenceFinder finder(reference, {0, 0, 5});
  CHECK(finder.closest({.origin = {0, 0, 5}, .direction = {0, 0, -1}, .ignored_body = 0}).found());
}

TEST_CASE("an empty scene is missed") {
  const ReferenceScene reference = apps::reference_scene(core::Scene{});
  const ReferenceFinder finder(reference, {0, 0, 5});
  CHECK_FALSE(finder.closest({.origin = {0, 0, 5}, .direction = {0, 0, -1}}).found());
  CHECK_FALSE(finder.any({.origin = {0, 0, 5}, .direction = {0, 0, -1}}).found());
}

}  // namespace
}  // namespace dmpc::tests::finder_test
