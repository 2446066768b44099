#include "core/picture/surfaces/path_step.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/sampling.h"

namespace path_step_test {

using namespace dmpc::core;

namespace {

/// Any pair, by chance.
SamplePair pair_of(std::uint64_t number) {
  const std::uint64_t bits = mix(number + 0x9e3779b97f4a7c15ULL);
  return {static_cast<double>(bits & 0xffffffffU) * 0x1p-32, static_cast<double>(bits >> 32U) * 0x1p-32};
}

/// Right-angled to `normal`, of unit length.
Vec3d aside_of(const Vec3d& normal) {
  return normalize(cross(normal, std::fabs(normal.x) < 0.5 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0}));
}

constexpr int rings = 8, sectors = 16;

/// The bin of a direction on the hemisphere, of which each is as likely where a direction is as likely as its cosine.
int bin_of(const Vec3d& direction, const Vec3d& normal) {
  const Vec3d aside = aside_of(normal), other = cross(normal, aside);
  const double cosine = dot(direction, normal),
               turn = std::atan2(dot(direction, other), dot(direction, aside)) / 6.283185307179586;
  const int ring = std::min(static_cast<int>(cosine * cosine * rings), rings - 1);
  return ring * sectors + std::min(static_cast<int>((turn + 0.5) * sectors), sectors - 1);
}

/// A white hit at depth 1 of which all is known, whose normal is z.
HitState white_hit() {
  HitState state;
  state.geometric_normal = state.normal = {0, 0, 1};
  state.ray.go_along({0, 0, -1});
  state.surface = {.material = {.color = {1, 1, 1}, .diffuse = 1}};
  state.set_gloss({});
  state.has_refraction = true;
  state.stage = HitState::Stage::continued;
  return state;
}

}  // namespace

TEST_CASE("directions are as likely as their cosine: a chi-square of 10^5 of them, about normals of every octant") {
  for (const Vec3d& way : {Vec3d{0, 0, 1}, Vec3d{0, 0, -1}, Vec3d{1, 2, -3}, Vec3d{-1, 0.1, 0.2}, Vec3d{0.3, -5, 0.1}}) {
    const Vec3d normal = normalize(way);
    std::array<int, rings * sectors> found{};
    constexpr int draws = 100'000;
    for (std::uint64_t draw = 0; draw < draws; ++draw) {
      const Vec3d direction = cosine_direction(pair_of(draw), normal);
      REQUIRE(std::fabs(length(direction) - 1) < 1e-14);
      REQUIRE(dot(direction, normal) >= 0);
      ++found[static_cast<std::size_t>(bin_of(direction, normal))];
    }
    const double expected = double{draws} / found.size();
    double chi_square = 0;
    for (const int count : found) {
      chi_square += (count - expected) * (count - expected) / expected;
    }
    CHECK(chi_square < 200);  // of 127 degrees of freedom more is less likely than 10^-4
    CHECK(chi_square > 70);
  }
}

TEST_CASE("directions of a square's corners and middle lie where the map has them") {
  const Vec3d up{0, 0, 1};
  CHECK(cosine_direction({0.5, 0.5}, up) == up);
  CHECK(length(cosine_direction({0.5, 1 - 0x1p-32}, up) - Vec3d{0, 1, 0}) < 1e-4);
  CHECK(std::fabs(cosine_direction({0, 0}, up).z) < 1e-7);
}

TEST_CASE("a white surface sends light on as it comes, and a black one none") {
  HitState state = white_hit();
  for (std::uint32_t pixel = 0; pixel < 100; ++pixel) {
    state.ray.pixel = pixel;
    const auto step = path_step(state);
    REQUIRE(step);
    CHECK(step->weight == Color{1, 1, 1});
    CHECK(step->kind == RayKind::scattered);
    CHECK(step->towards.z > 0);
  }
  state.surface.material.diffuse = 0;
  CHECK(!path_step(state));
}

TEST_CASE("each way counts for all as often as it is taken: on average what the material says") {
  HitState state = white_hit();
  state.surface.material = {
      .color = {1, 0.5, 0.25}, .diffuse = 0.5, .specular = 0.25, .transmittance = 0.125, .refraction_index = 1};
  Vec3d scattered, mirrored, let_through;
  constexpr std::uint32_t draws = 4096;
  for (std::uint32_t sample = 0; sample < draws; ++sample) {
    state.ray.sample = static_cast<std::uint16_t>(sample);
    const auto step = path_step(state);
    REQUIRE(step);
    Vec3d& sum = step->kind == RayKind::reflected ? mirrored : step->kind == RayKind::refracted ? let_through : scattered;
    sum = sum + Vec3d(step->weight) * (1.0 / draws);
  }
  CHECK(scattered.x == doctest::Approx(0.5).epsilon(0.002).scale(0));
  CHECK(scattered.z == doctest::Approx(0.125).epsilon(0.002).scale(0));
  CHECK(mirrored.y == doctest::Approx(0.25).epsilon(0.002).scale(0));
  CHECK(let_through.y == doctest::Approx(0.125).epsilon(0.004).scale(0));
}

TEST_CASE("from the third hit on a path goes on as often as its weight says, and then has the weight of all") {
  HitState state = white_hit();
  state.surface.material.color = {0.25, 0.125, 0.0625};
  for (const std::uint8_t depth : {std::uint8_t{2}, std::uint8_t{3}, std::uint8_t{7}}) {
    state.ray.depth = depth;
    int survivors = 0;
    double sum = 0;
    for (std::uint32_t sample = 0; sample < 4096; ++sample) {
      state.ray.sample = static_cast<std::uint16_t>(sample);
      if (const auto step = path_step(state)) {
        ++survivors;
        sum += double{step->weight.y} / 4096;
      }
    }
    CHECK(survivors == (depth == 2 ? 4096 : 1024));  // a leaf of 2^12 numbers has so many below a quarter
    CHECK(sum == doctest::Approx(0.125).epsilon(1e-6).scale(0));
  }
}

TEST_CASE("a path that a surface has scattered stays one that has been scattered") {
  HitState state = white_hit();
  state.surface.material = {.specular = 1};
  CHECK(path_step(state)->kind == RayKind::reflected);
  state.ray.kind = RayKind::scattered;
  CHECK(path_step(state)->kind == RayKind::scattered);
}

TEST_CASE("no path leads into the surface, however the normal leans") {
  HitState state = white_hit();
  state.normal = normalize(Vec3d{1, 0, 0.2});
  int lost = 0;
  for (std::uint32_t sample = 0; sample < 1024; ++sample) {
    state.ray.sample = static_cast<std::uint16_t>(sample);
    const auto step = path_step(state);
    lost += step ? 0 : 1;
    CHECK((!step || step->towards.z > 0));
  }
  CHECK(lost > 100);
  CHECK(lost < 600);
}

}  // namespace path_step_test
