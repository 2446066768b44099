// What a hit on a surface of microfacets does with light, against integrals and against what it must not do.
#include "core/picture/surfaces/microfacet_lobes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>

#include "core/base/sampling.h"
#include "tests/support/microfacet_hits.h"

namespace microfacet_lobes_test {

using namespace dmpc::core;
using namespace dmpc::tests;

namespace {

constexpr double pi = 3.14159265358979324;
const Vec3d white{1, 1, 1}, gold{1, 0.75, 0.25};

/// Any pair, by chance.
SamplePair pair_of(std::uint64_t number) {
  const std::uint64_t bits = mix(number + 0x9e3779b97f4a7c15ULL);
  return {static_cast<double>(bits & 0xffffffffU) * 0x1p-32, static_cast<double>(bits >> 32U) * 0x1p-32};
}

/// Anywhere above the surface.
Vec3d direction_of(std::uint64_t number) {
  const SamplePair pair = pair_of(number);
  const double wide = std::sqrt(std::max(0.0, 1 - pair.x * pair.x)), turn = 2 * pi * pair.y;
  return {wide * std::cos(turn), wide * std::sin(turn), pair.x};
}

/// over(in, solid angle) for a grid of directions above the surface.
template <class Over>
void over_hemisphere(int steps, int sectors, const Over& over) {
  for (int ring = 0; ring < steps; ++ring) {
    const double tilt = 0.5 * pi * (ring + 0.5) / steps, wide = std::sin(tilt), height = std::cos(tilt);
    for (int sector = 0; sector < sectors; ++sector) {
      const double turn = 2 * pi * (sector + 0.5) / sectors;
      over(Vec3d{wide * std::cos(turn), wide * std::sin(turn), height}, wide * pi * pi / steps / sectors);
    }
  }
}

/// The share of uniform light that goes to an eye at this cosine, by quadrature.
Vec3d share_by_sum(const Material& material, double cosine, int steps = 400) {
  const int sectors = steps * (material.microfacets.roughness < 0.25 ? 8 : 1);  // grazing light goes on in a narrow fan
  const HitState state = hit_on(material, eye_at(cosine));
  const MicrofacetLobes lobes(state);
  Vec3d sum;
  over_hemisphere(steps, sectors, [&](const Vec3d& in, double angle) { sum = sum + lobes.response(in) * angle; });
  return sum;
}

/// That share by sampled steps.
Vec3d share_by_steps(const Material& material, double cosine) {
  const HitState state = hit_on(material, eye_at(cosine));
  const MicrofacetLobes lobes(state);
  Vec3d sum;
  constexpr std::uint32_t draws = 16384;
  for (std::uint32_t sample = 0; sample < draws; ++sample) {
    if (const auto step = lobes.step(sample_pair(7, sample, 1), sample_pair(7, sample, 2))) {
      sum = sum + Vec3d(step->weight) * (1.0 / draws);
    }
  }
  return sum;
}

/// What one scattering leaves: alpha, the eye's cosine, the share. By a quadrature over normals in another program, of 1500 x
/// 1500 steps, the tail of steep ones as fine as the rest.
const std::tuple<double, double, double> left_by_one[] = {
    {0.04, 1, .99830}, {0.04, 0.5, .99545}, {0.04, 0.1, .92900}, {0.25, 1, .91581}, {0.25, 0.5, .85726}, {0.25, 0.1, .89162},
    {0.5, 1, .68785},  {0.5, 0.5, .69825},  {0.5, 0.1, .86010},  {1, 1, .30685},    {1, 0.5, .45069},    {1, 0.1, .76021}};

}  // namespace

TEST_CASE("tiny mirrors that reflect all send on what one scattering leaves, by quadrature and by steps") {
  for (const auto& [alpha, cosine, share] : left_by_one) {
    CAPTURE(alpha);
    CAPTURE(cosine);
    const Material mirrors = microfacets(white, 1, alpha);
    CHECK(share_by_sum(mirrors, cosine).x == doctest::Approx(share).epsilon(0.001).scale(0));
    CHECK(share_by_steps(mirrors, cosine).y == doctest::Approx(share).epsilon(0.001).scale(0));
  }
}

TEST_CASE("steps find what the response adds up to, of metals, of what is none, and of what is both") {
  for (const double metallic : {0.0, 0.4, 1.0}) {
    for (const double alpha : {0.2, 0.4, 1.0}) {
      for (const double cosine : {1.0, 0.4, 0.1}) {
        CAPTURE(metallic);
        CAPTURE(alpha);
        CAPTURE(cosine);
        const Material material = microfacets(gold, metallic, alpha);
        const Vec3d sum = share_by_sum(material, cosine), steps = share_by_steps(material, cosine);
        CHECK(largest_component(sum - steps) < 0.004 * sum.x + 1e-3);
      }
    }
  }
}

TEST_CASE("no more light leaves than comes, from whatever side, though a white surface may send on nearly all") {
  for (const double metallic : {0.0, 0.5, 1.0}) {
    for (const double alpha : {0.2, 0.35, 0.5, 0.75, 1.0}) {
      for (const double cosine : {1.0, 0.8, 0.6, 0.4, 0.2, 0.1}) {
        CHECK(share_by_sum(microfacets(white, metallic, alpha), cosine, 250).x < 1.0005);
      }
    }
  }
  const Material smooth = microfacets(white, 0, 0);
  for (const double cosine : {1.0, 0.5, 0.2}) {
    CHECK(share_by_steps(smooth, cosine).x == doctest::Approx(1).epsilon(0.001).scale(0));
  }
}

TEST_CASE("the response is the same both ways") {
  for (const double metallic : {0.0, 0.5, 1.0}) {
    for (std::uint64_t i = 0; i < 100'000 / 3; ++i) {
      const Vec3d in = direction_of(3 * i), out = direction_of(3 * i + 1);
      const double alpha = 0.01 + 0.99 * pair_of(3 * i + 2).x;
      const HitState there = hit_on(microfacets(gold, metallic, alpha), out),
                     back = hit_on(microfacets(gold, metallic, alpha), in);
      const Vec3d one = MicrofacetLobes(there).response(in) * (1 / in.z),
                  other = MicrofacetLobes(back).response(out) * (1 / out.z);
      REQUIRE(largest_component(one - other) <= 1e-6 * std::max(1.0, largest_component(one)));
    }
  }
}

TEST_CASE("a metal keeps its tint ahead, and loses it where light grazes; what is none has white highlights") {
  const HitState ahead = hit_on(microfacets(gold, 1, 0.2), {0, 0, 1});
  const Vec3d tinted = MicrofacetLobes(ahead).response({0, 0, 1});
  CHECK(tinted.y / tinted.x == doctest::Approx(0.75));
  CHECK(tinted.z / tinted.x == doctest::Approx(0.25));
  const HitState grazing = hit_on(microfacets(gold, 1, 0.2), eye_at(0.01));
  const Vec3d pale = MicrofacetLobes(grazing).response({-eye_at(0.01).x, 0, 0.01});
  CHECK(pale.z / pale.x > 0.95);
  const HitState lacquer = hit_on(microfacets({0.5, 0, 0}, 0, 0.1), {0, 0, 1});
  const Vec3d highlight = MicrofacetLobes(lacquer).response({0, 0, 1});
  CHECK(highlight.y == highlight.z);
  CHECK(pi * highlight.y == doctest::Approx(0.04 / (4 * 0.01)));  // pi D V F, with D = 1 / (pi alpha^2) and V = 1/4
  CHECK(pi * (highlight.x - highlight.y) == doctest::Approx(0.5 * 0.96 * 1.05));
}

TEST_CASE("what is smoother than a limit mirrors: in its tint, nothing of a point light, as likely as nothing else") {
  const HitState state = hit_on(microfacets(gold, 1, 0), eye_at(0.5));
  const MicrofacetLobes lobes(state);
  CHECK(lobes.response({-eye_at(0.5).x, 0, 0.5}) == Vec3d{});
  CHECK(lobes.density({-eye_at(0.5).x, 0, 0.5}) == 0);
  const auto step = lobes.step({0.5, 0.5}, {0.3, 0.3});
  REQUIRE(step);
  CHECK(length(step->towards - Vec3d{-eye_at(0.5).x, 0, 0.5}) < 1e-12);
  CHECK(step->kind == RayKind::reflected);
  CHECK(step->weight.z == doctest::Approx(0.25 + 0.75 * 0.03125));
}

TEST_CASE("the density of steps is that of the ways together, and 1 but for what leads below the surface") {
  for (const double metallic : {0.0, 0.5, 1.0}) {
    for (const double alpha : {0.2, 1.0}) {
      CAPTURE(metallic);
      CAPTURE(alpha);
      const HitState state = hit_on(microfacets(gold, metallic, alpha), eye_at(0.3));
      const MicrofacetLobes lobes(state);
      double sum = 0;
      over_hemisphere(500, 500, [&](const Vec3d& in, double angle) { sum += lobes.density(in) * angle; });
      int lost = 0;
      constexpr int draws = 65536;
      for (std::uint32_t sample = 0; sample < draws; ++sample) {
        lost += lobes.step(sample_pair(5, sample, 1), sample_pair(5, sample, 2)) ? 0 : 1;
      }
      CHECK(sum + static_cast<double>(lost) / draws == doctest::Approx(1).epsilon(0.002).scale(0));
    }
  }
}

TEST_CASE("light below the true surface, or the blended normal, is lost on the way in as on the way out") {
  for (const bool leaving : {false, true}) {
    HitState state = hit_on(microfacets(white, 0.5, 0.6), eye_at(0.5));
    state.normal = normalize(Vec3d{1, 0, 0.3});
    state.leaving = leaving;
    state.geometric_normal = {0, 0, leaving ? -1.0 : 1.0};
    const MicrofacetLobes lobes(state);
    int lost = 0;
    for (std::uint32_t sample = 0; sample < 4096; ++sample) {
      const auto step = lobes.step(sample_pair(3, sample, 1), sample_pair(3, sample, 2));
      lost += step ? 0 : 1;
      if (step) {
        REQUIRE(step->towards.z > 0);
        REQUIRE(dot(step->towards, state.normal) > 0);
        REQUIRE(largest_component(Vec3d(step->weight)) <= bound_of(microfacets(white, 0.5, 0.6)).passed_on);
      }
    }
    CHECK(lost > 400);
    CHECK(lost < 3000);
    const Vec3d below = normalize(Vec3d{1, 0, -0.01});
    CHECK(lobes.response(below) == Vec3d{});
    CHECK(lobes.density(below) == 0);
    CHECK(largest_component(lobes.response(normalize(Vec3d{1, 0, 0.01}))) > 0);
  }
}

TEST_CASE("an eye below the blended normal sees what one sees that is as far above it") {
  HitState below = hit_on(microfacets(gold, 0.5, 0.4), normalize(Vec3d{-1, 0, 0.1})), above = below;
  below.normal = above.normal = normalize(Vec3d{1, 0, 1});
  const Vec3d out = -below.ray.full_direction();
  above.ray.go_along(-(out - below.normal * (2 * dot(out, below.normal))));
  const Vec3d in = normalize(Vec3d{0.2, 0.4, 1});
  CHECK(length(MicrofacetLobes(below).response(in) - MicrofacetLobes(above).response(in)) < 1e-12);
  CHECK(MicrofacetLobes(below).density(in) == doctest::Approx(MicrofacetLobes(above).density(in)));
}

TEST_CASE(
    "what alpha leaves out lets rays through straight, what transmits bends them, and mirrors reflect the same from within") {
  Material veil = microfacets(white, 1, 0.3);
  veil.microfacets.opacity = 0.25;
  const HitState thin = hit_on(veil, eye_at(0.5));
  int through = 0;
  for (std::uint32_t sample = 0; sample < 4096; ++sample) {
    const auto step = MicrofacetLobes(thin).step(sample_pair(3, sample, 1), sample_pair(3, sample, 2));
    if (step && step->kind == RayKind::refracted) {
      ++through;
      CHECK(length(step->towards + eye_at(0.5)) < 1e-12);
    }
  }
  CHECK(through == doctest::Approx(0.75 * 4096).epsilon(0.001).scale(0));
  Material glass = microfacets(white, 0, 0);
  glass.microfacets.transmission = 1;
  glass.refraction_index = 1.5;
  HitState outside = hit_on(glass, eye_at(0.5)), within = outside;
  const double sine_within = eye_at(0.5).x / 1.5, cosine_within = std::sqrt(1 - sine_within * sine_within);
  within.ray.go_along(-Vec3d{sine_within, 0, cosine_within});
  within.leaving = true;
  within.geometric_normal = {0, 0, -1};
  const auto mirrored = [](const HitState& state) {
    double sum = 0;
    for (std::uint32_t sample = 0; sample < 4096; ++sample) {
      const auto step = MicrofacetLobes(state).step(sample_pair(3, sample, 1), sample_pair(3, sample, 2));
      sum += step && step->kind == RayKind::reflected ? double{step->weight.x} / 4096 : 0;
    }
    return sum;
  };
  const double expected = 0.04 + 0.96 * 0.03125;
  CHECK(mirrored(outside) == doctest::Approx(expected).epsilon(0.01).scale(0));
  CHECK(mirrored(within) == doctest::Approx(expected).epsilon(0.01).scale(0));
}

TEST_CASE("a half-transparent white lacquer sends on all that comes from within, in no more than the bound says") {
  Material plastic = microfacets(white, 0, 0);
  plastic.microfacets.transmission = plastic.transmittance = 0.5;
  plastic.refraction_index = 1.5;
  const MicrofacetBound bound = bound_of(plastic);
  for (const double cosine : {1.0, 0.9, 0.8}) {  // of the critical angle: 0.745
    CAPTURE(cosine);
    HitState within = hit_on(plastic, eye_at(cosine));
    within.leaving = true;
    within.geometric_normal = {0, 0, -1};
    const MicrofacetLobes lobes(within);
    double sum = 0;
    constexpr std::uint32_t draws = 16384;
    for (std::uint32_t sample = 0; sample < draws; ++sample) {
      if (const auto step = lobes.step(sample_pair(7, sample, 1), sample_pair(7, sample, 2))) {
        sum += double{step->weight.x} / draws;
        REQUIRE(double{step->weight.x} <= bound.passed_on);
        REQUIRE(pi * largest_component(lobes.response(step->towards)) <= bound.direct);
      }
    }
    CHECK(sum == doctest::Approx(1).epsilon(0.01).scale(0));
  }
}

TEST_CASE("no step weighs more than the bound, and no point light shows more of itself") {
  for (const double metallic : {0.0, 0.3, 1.0}) {
    for (const double alpha : {0.003, 0.05, 0.4, 1.0}) {
      for (const Vec3d& base : {white, gold, Vec3d{0.01, 0, 0}}) {
        const Material material = microfacets(base, metallic, alpha);
        const MicrofacetBound bound = bound_of(material);
        CHECK(bound.passed_on < 5);
        for (std::uint32_t sample = 0; sample < 2000; ++sample) {
          const HitState state = hit_on(material, direction_of(sample));
          const MicrofacetLobes lobes(state);
          const auto step = lobes.step(sample_pair(3, sample, 1), sample_pair(3, sample, 2));
          if (step) {
            REQUIRE(double{std::max({step->weight.x, step->weight.y, step->weight.z})} <= bound.passed_on);
            REQUIRE(pi * largest_component(lobes.response(step->towards)) <= bound.direct);
          }
        }
      }
    }
  }
  CHECK(sent_on_straight(microfacets(white, 0.5, 0.5)) <= 1 + 1e-12);
  CHECK(sent_on_straight(microfacets({2, 1, 1}, 0.5, 0.5)) > 1.4);
}

}  // namespace microfacet_lobes_test
