// What shines by itself and is aimed at, held against what can be said on paper: the same light as by chance, with less noise.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "core/picture/lights/emitter_light.h"
#include "core/picture/surfaces/path_step.h"
#include "core/picture/surfaces/surface_response.h"
#include "core/record/emitter.h"
#include "tests/support/path_studio.h"
#include "tests/support/scaled.h"

namespace emitters_test {

using namespace dmpc::core;
using namespace dmpc::tests;

namespace {

constexpr std::uint32_t many = 1024;
/// What paths aim at counts there alone: an estimator of its own.
constexpr Transport aiming_alone{.kind = TransportKind::paths, .only_aims = true};

/// A square that shines, of side 1, one above the floor's origin.
Scene below_square(double albedo) {
  Scene scene = floor_of(grey(albedo));
  SceneBuilder builder(scene);
  builder.material(grey(0, 1));
  builder.polygon({{-0.5, -0.5, 1}, {0.5, -0.5, 1}, {0.5, 0.5, 1}, {-0.5, 0.5, 1}});
  return seen_at_origin(scene, {-3, 0, 0.5});
}

Scene below_ball(const Vec3d& center, double radius) {
  Scene scene = floor_of(grey(0.8));
  SceneBuilder builder(scene);
  builder.material(grey(0, 1));
  builder.sphere(center, radius);
  return seen_at_origin(scene, {-3, 0, 0.5});
}

/// What a unit square on the floor shows, as a whole, in a picture of so many pixels a side: from straight above.
View of_unit_square(const Vec3d& middle, double height, int side) {
  const double middles = std::atan(0.5 / height * (side - 1) / side);
  return {.from = middle + Vec3d{0, 0, height},
          .at = middle,
          .up = {0, 1, 0},
          .angle_degrees = 2 * middles * 180 / 3.14159265358979324};
}

/// A hollow ball of radius 1 around the origin with this reflectance, and in it a small black emitting one.
Scene hollow_ball(double albedo, const Vec3d& place, double radius) {
  Scene scene;
  SceneBuilder builder(scene);
  builder.material(grey(albedo));
  builder.sphere({0, 0, 0}, -1);
  builder.material(grey(0, 1));
  builder.sphere(place, radius);
  scene.view = {.from = {0, 0.5, 0}, .at = {0.2, 1, 0.1}, .up = {0, 0, 1}, .angle_degrees = 60};
  return scene;
}

/// A room with a ball in it, a large panel near a wall and a small ball far away, both of which shine.
Scene lit_by_two() {
  Scene scene;
  SceneBuilder builder(scene);
  builder.material(grey(0.7));
  add_box(builder, {-1, -1, -1}, {1, 1, 1});
  builder.sphere({0.3, 0.3, -0.4}, 0.5);
  builder.material(grey(0.2, 0.5));
  builder.polygon({{-0.95, -0.8, -0.8}, {-0.95, 0.8, -0.8}, {-0.95, 0.8, 0.2}, {-0.95, -0.8, 0.2}});
  builder.material(grey(0, 20));
  builder.sphere({0.6, -0.5, 0.7}, 0.1);
  scene.view = {.from = {-0.1, -0.9, 0.1}, .at = {0, 0, -0.2}, .up = {0, 0, 1}, .angle_degrees = 60};
  return scene;
}

/// A room with a ball in it and a square of the ceiling that shines.
Scene lit_from_ceiling() {
  Scene scene;
  SceneBuilder builder(scene);
  const auto rectangle = [&](const Vec3d& corner, const Vec3d& along, const Vec3d& across) {
    builder.polygon({corner, corner + along, corner + along + across, corner + across});
  };
  builder.material(grey(0.7));
  rectangle({0, 0, 0}, {1, 0, 0}, {0, 0, 1});
  for (const double side : {0.0, 1.0}) {
    rectangle({side, 0, 0}, {0, 1, 0}, {0, 0, 1});
    rectangle({0, 0, side}, {1, 0, 0}, {0, 1, 0});
    rectangle({0, 1, 0.75 * side}, {1, 0, 0}, {0, 0, 0.25});
    rectangle({0.75 * side, 1, 0.25}, {0.25, 0, 0}, {0, 0, 0.5});
  }
  builder.sphere({0.5, 0.25, 0.5}, 0.22);
  builder.material(grey(0, 1));
  rectangle({0.25, 1, 0.25}, {0.5, 0, 0}, {0, 0, 0.5});
  scene.view = {.from = {0.5, 0.5, 0.001}, .at = {0.5, 0.5, 1}, .up = {0, 1, 0}, .angle_degrees = 73.74};
  return scene;
}

/// Single steps of the reference renderer.
class Steps {
 public:
  explicit Steps(const Studio& studio) : header_(studio.header()), records_(studio.records()), tracer_(records_, header_, {}) {}

  /// A ray's hit, of which all is known.
  HitState hit_of(const Ray& ray) {
    Cursor cursor;
    REQUIRE(tracer_.trace(ray, cursor, operations_) == Traced::hit);
    HitState state = begin_shading(ray, cursor.best);
    while (!state.has_surface()) {
      Ray none;
      step(state, none);
    }
    return state;
  }
  bool step(HitState& state, Ray& child) {
    const Address address = record_needed(state, header_);
    return Shader(header_, options_, {}, operations_)
        .step(state, address == no_address ? nullptr : records_.find(address), child);
  }
  EmitterRecord emitter(std::uint32_t index) const { return read<EmitterRecord>(records_.find(emitter_address(header_, index))); }

 private:
  const DatabaseHeader& header_;
  LocalRecords records_;
  GridTracer<LocalRecords> tracer_;
  ShadeOptions options_{.depth_max = 3, .transport = paths};
  Operations operations_;
};

}  // namespace

TEST_CASE("a floor below the middle of a square that shines, one above, shows 0.239456 of it with few samples") {
  const Studio studio(below_square(0.8), many);
  CHECK(studio.header().emitter_count == 2);
  CHECK(studio.mean(1, 1024, paths, 0) == doctest::Approx(0.8 * 0.239456).epsilon(0.001).scale(0));
  CHECK(studio.mean(1, 1024, aiming_alone, 0) == doctest::Approx(0.8 * 0.239456).epsilon(0.001).scale(0));
}

TEST_CASE("a lamp lights in its ceiling's plane, whichever comes first, as it does without the ceiling") {
  for (const double tilt : {0.0, 0.2}) {
    CAPTURE(tilt);
    const auto square = [tilt](SceneBuilder& builder, double half, double shine) {
      builder.material(grey(0, shine));
      const auto at = [tilt](double x, double y) { return Vec3d{x, y, 1 + tilt * x}; };
      builder.polygon({at(-half, -half), at(half, -half), at(half, half), at(-half, half)});
    };
    const auto mean_of = [&](std::initializer_list<double> halves, const Transport& transport) {
      Scene scene = floor_of(grey(0.8));
      SceneBuilder builder(scene);
      for (const double half : halves) {
        square(builder, half, half < 1 ? 1 : 0);
      }
      return Studio(seen_at_origin(scene, {-0.5, 0, 0.5}), many).mean(1, 1024, transport, 1);
    };
    const double alone = mean_of({0.5}, paths);
    for (const std::initializer_list<double> halves : {std::initializer_list<double>{0.5, 2}, {2, 0.5}}) {
      CHECK(mean_of(halves, paths) == doctest::Approx(alone).epsilon(0.002).scale(0));
      CHECK(mean_of(halves, aiming_alone) == doctest::Approx(alone).epsilon(0.002).scale(0));
    }
  }
}

TEST_CASE("a coarse smooth matt surface gets nothing of what shines behind its true one, though its blended normal sees that") {
  const auto lit_from = [](const Vec3d& center) {
    Scene scene;
    SceneBuilder builder(scene);
    builder.material(grey(0.8));
    const Vec3d leaning = normalize(Vec3d{1, 0, 0.5});
    builder.patch({{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}}, {leaning, leaning, leaning});
    builder.material(grey(0, 1));
    builder.sphere(center, 0.3);
    return Studio(seen_at_origin(scene, {0.5, 0, 1}), many);
  };
  CHECK(lit_from({2, 0, 1}).mean(1, 256, paths, 0) > 0.005);
  for (const Transport& transport : {paths, aiming_alone}) {
    CHECK(lit_from({2, 0, -0.5}).mean(1, 256, transport, 0) == 0);
  }
}

TEST_CASE("a floor below a ball that shines shows the cosine times the square of its radius over its distance") {
  for (const Vec3d& center : {Vec3d{0, 0, 2}, Vec3d{0.6, 0, 1.8}, Vec3d{3, 2, 1}}) {
    const double square = dot(center, center), exact = 0.8 * center.z / std::sqrt(square) * 0.25 / square;
    const Studio studio(below_ball(center, 0.5), many);
    CHECK(studio.mean(1, 256, paths, 0) == doctest::Approx(exact).epsilon(0.001).scale(0));
    CHECK(studio.mean(1, 256, aiming_alone, 0) == doctest::Approx(exact).epsilon(0.001).scale(0));
  }
}

TEST_CASE("of a square that shines a parallel one, one away, gets 0.199825, and one at a right angle to an edge 0.200044") {
  constexpr int side = 8;
  for (const bool is_parallel : {true, false}) {
    const int samples = is_parallel ? 64 : 8192 / static_cast<int>(slowness);  // near the edge light falls from close by
    Scene scene = floor_of(grey(1));
    SceneBuilder builder(scene);
    builder.material(grey(0, 1));
    is_parallel ? builder.polygon({{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}})
                : builder.polygon({{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}});
    scene.view = of_unit_square({0.5, 0.5, 0}, is_parallel ? 0.5 : 1.0, side);
    const Studio studio(scene, many);
    CHECK(studio.mean(side, samples, paths, 0) ==
          doctest::Approx(is_parallel ? 0.199825 : 0.200044).epsilon(slowness == 1 ? 0.002 : 0.005).scale(0));
  }
}

TEST_CASE("in a hollow ball of albedo a light of power P comes back as a P / (4 pi R^2 (1 - a)) everywhere") {
  constexpr double albedo = 0.8, radius = 0.02;
  const double first = radius * radius;  // over pi, of a ball that shines with 1 in the middle; as much of all it sees it takes
  for (const Vec3d& place : {Vec3d{0, 0, 0}, Vec3d{-0.3, -0.2, 0.1}}) {
    CAPTURE(place.x);
    const Studio studio(hollow_ball(albedo, place, radius), many);
    const Film once = studio.film(scaled_edge(16), 64, paths, 0), all = studio.film(scaled_edge(16), 64, paths, 120);
    const double indirect = Studio::mean_of(all) - Studio::mean_of(once);
    const double lost = place == Vec3d{} ? first : 0;
    const double exact = albedo * first / (1 - albedo * (1 - lost)) * albedo * (1 - lost);
    CHECK(indirect == doctest::Approx(exact).epsilon(slowness == 1 ? 0.005 : 0.08).scale(0));
    CHECK((place == Vec3d{} ? Studio::mean_of(once) : albedo * first) == doctest::Approx(albedo * first).epsilon(0.002).scale(0));
  }
}

TEST_CASE("to aim alone, to meet by chance alone, and both, weighed, have one mean; both vary little more than the better" *
          doctest::test_suite("slow")) {
  const int side = scaled_edge(16), samples = 64;
  for (const Scene& scene : {lit_by_two(), lit_from_ceiling()}) {
    for (const int bounces : {0, 2}) {
      CAPTURE(bounces);
      const Studio aiming(scene, many), meeting(scene);
      WaysToLight{.reference = aiming.square(side, 2048, bounces, 3),
                  .both = aiming.square(side, samples, bounces, 1),
                  .aimed = aiming.square(side, samples, bounces, 1, aiming_alone),
                  .met = meeting.square(side, samples, bounces, 1)}
          .check(slowness == 1 ? 1.1 : 2.0);
    }
  }
}

TEST_CASE(
    "errors fall by samples to the power of -0.6 after one bounce and of -0.53 after three: numbers are even, and each one's "
    "own" *
    doctest::test_suite("slow")) {
  const Studio studio(lit_from_ceiling(), many);
  const int side = slowness == 1 ? 8 : 4;
  for (const auto& [bounces, slope] : {std::pair{1, -0.6}, std::pair{3, -0.53}}) {
    CAPTURE(bounces);
    const std::vector<double> reference = studio.square(side, slowness == 1 ? 8192 : 4096, bounces, 3);
    const double few = rmse(studio.square(side, 16, bounces, 1), reference);
    const double more = rmse(studio.square(side, 1024, bounces, 1), reference);
    CHECK(std::log(more / few) / std::log(64.0) <= slope * (slowness == 1 ? 1.0 : 0.5));  // few pixels tell little
  }
}

TEST_CASE("of one light what is aimed at counts for a share, and what is met there for the rest, to rounding") {
  Scene flat = floor_of(grey(0.8));
  SceneBuilder builder(flat);
  builder.material(grey(0, 1));
  builder.polygon({{-0.5, -0.5, 1}, {2.5, -0.5, 1.5}, {0.5, 1.5, 0.7}});
  for (const Scene& scene : {seen_at_origin(flat, {-3, 0, 0.5}), below_ball({0.6, 0.2, 0.9}, 0.7)}) {
    const Studio studio(scene, many);
    REQUIRE(studio.header().emitter_count == 1);
    Steps steps(studio);
    for (std::uint32_t pixel = 0; pixel < 200; ++pixel) {
      Ray eye = studio.eye_ray();
      eye.pixel = pixel;
      HitState floor = steps.hit_of(eye);
      REQUIRE(floor.stage == HitState::Stage::emitter);
      const auto place =
          aim_at(steps.emitter(0), floor.point, {double{floor.surface.place}, pair_of(floor.ray, Purpose::place).y});
      REQUIRE(place);
      Ray ray;
      REQUIRE(steps.step(floor, ray));
      const SurfaceResponse response = response_towards(floor, ray.full_direction());
      const double aimed = double{ray.weight.x} * place->density / response.value.x;
      ray.kind = RayKind::scattered;
      ray.t_max = std::numeric_limits<float>::infinity();
      ray.depth = 2;
      ray.weight = {1, 1, 1};
      ray.density = density_bits(response.density);
      const double met{steps.hit_of(ray).emission().x};
      CHECK(aimed > 0.01);
      CHECK(aimed + met == doctest::Approx(1).epsilon(1e-5).scale(0));
      Ray onward;
      REQUIRE(floor.stage == HitState::Stage::continued);
      REQUIRE(steps.step(floor, onward));
      CHECK(onward.density == density_bits(response_towards(floor, onward.full_direction()).density));
    }
  }
}

TEST_CASE("however few are aimed at, the light is the same: others are met by chance") {
  Scene scene = floor_of(grey(0.8));
  SceneBuilder builder(scene);
  for (int i = 0; i < 9; ++i) {
    builder.material(grey(0, 1.0 + i));
    builder.sphere({0.9 * (i % 3 - 1), 0.9 * (i / 3 - 1), 1.5}, 0.4);
  }
  scene = seen_at_origin(scene, {-3, 0, 0.5});
  const double all = Studio(scene, many).mean(1, 4096, paths, 0);
  for (const std::uint32_t emitters : {0U, 1U, 4U, 9U}) {
    const Studio studio(scene, emitters);
    CHECK(studio.header().emitter_count == emitters);
    CHECK(studio.mean(1, 16384, paths, 0) == doctest::Approx(all).epsilon(emitters == 9 ? 0.002 : 0.01).scale(0));
  }
}

TEST_CASE("a mirror, and the eye, see what is aimed at as it is") {
  Scene scene = floor_of({.diffuse = 0, .specular = 1});
  SceneBuilder builder(scene);
  builder.material(grey(0, 3));
  builder.sphere({0, 0, 2}, 0.5);
  scene.background = {};
  CHECK(Studio(seen_at_origin(scene, {0.01, 0, 1}), many).mean(1, 16, paths, 4) == 3);
  Scene seen = scene;
  seen.view = {.from = {0, -3, 2}, .at = {0, 0, 2}, .up = {0, 0, 1}, .angle_degrees = 1e-3};
  CHECK(Studio(seen, many).mean(1, 16, paths, 4) == 3);
}

TEST_CASE("a room whose ball of a wall shines is aimed at by nobody within, and has the light that it had") {
  const Studio aiming(room(grey(0.5, 1), true), many), meeting(room(grey(0.5, 1), true));
  CHECK(aiming.header().emitter_count == 1);
  CHECK(aiming.film(8, 2, paths, 3).hash() == meeting.film(8, 2, paths, 3).hash());
}

TEST_CASE("a closed box that shines has 2 (1 - 2^-(b + 2)) of light when paths aim at its walls, too") {
  const Studio studio(room(grey(0.5, 1), false), many);
  for (const int bounces : {0, 1, 3, 8}) {
    CAPTURE(bounces);
    const double exact = 2 * (1 - std::ldexp(1.0, -(bounces + 2)));
    const Film film = studio.film(scaled_edge(48), 16, paths, bounces);
    CHECK(std::fabs(Studio::mean_of(film) - exact) < 4 * standard_error(film) + 1e-6);
    CHECK(std::fabs(Studio::mean_of(film) - exact) < (slowness == 1 ? 0.004 : 0.02));
  }
}

TEST_CASE("254 bounces, behind which no ray can look for what shines, bring what they did") {
  const Studio aiming(room(grey(0, 1), false), many);
  CHECK(aiming.mean(8, 1, paths, 254) == 1);
}

TEST_CASE("no sample finds more light than the bound says where paths aim at what shines") {
  for (const Scene& scene : {lit_by_two(), below_ball({0.1, 0, 0.6}, 0.5), hollow_ball(0.9, {-0.3, -0.2, 0.1}, 0.02)}) {
    for (const int bounces : {0, 1, 5}) {
      check_bounded(Studio(scene, many).film(24, 1, paths, bounces), radiance_bound(scene, bounces + 2, paths));
    }
  }
}

TEST_CASE("who can see nothing of an emitter shoots no ray at it: below the surface, and off a mirror") {
  Scene below = floor_of(grey(0.8));
  SceneBuilder builder(below);
  builder.material(grey(0, 1));
  builder.sphere({0, 0, -2}, 0.5);
  const auto shadow = static_cast<std::size_t>(RayKind::shadow);
  const Studio studio(seen_at_origin(below, {-1, 0, 1}), many);
  CHECK(studio.mean(1, 16, paths, 0) == 0);
  CHECK(studio.operations.rays[shadow] == 0);
  CHECK(studio.operations.skipped.unlit == 16);
  Scene mirror = floor_of({.diffuse = 0, .specular = 1});
  SceneBuilder mirrored(mirror);
  mirrored.material(grey(0, 1));
  mirrored.sphere({0, 0, 2}, 0.5);
  const Studio dark(seen_at_origin(mirror, {-1, 0, 1}), many);
  dark.film(1, 16, paths, 0);
  CHECK(dark.operations.rays[shadow] == 0);
  CHECK(dark.operations.skipped.zero_terms == 16);
}

}  // namespace emitters_test
