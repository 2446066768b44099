// Tiny mirrors by themselves, against integrals.
#include "core/picture/surfaces/microfacet.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/sampling.h"

namespace microfacet_test {

using namespace dmpc::core;

namespace {

constexpr double pi = 3.14159265358979324;
const Vec3d up{0, 0, 1};

/// Any pair, by chance.
SamplePair pair_of(std::uint64_t number) {
  const std::uint64_t bits = mix(number + 0x9e3779b97f4a7c15ULL);
  return {static_cast<double>(bits & 0xffffffffU) * 0x1p-32, static_cast<double>(bits >> 32U) * 0x1p-32};
}

/// Towards the eye, at this cosine with z.
Vec3d eye_at(double cosine) { return {std::sqrt(1 - cosine * cosine), 0, cosine}; }

/// At this height and turn.
Vec3d direction_at(double height, double turn) {
  const double wide = std::sqrt(std::max(0.0, 1 - height * height));
  return {wide * std::cos(turn), wide * std::sin(turn), height};
}

/// Seen from `out`, for reflection into `in`, which may be below the surface.
double density(double alpha, const Vec3d& out, const Vec3d& in) {
  const Vec3d half = normalize(in + out);
  return half.z > 0 ? reflected_density(alpha, out.z, half.z) : 0;
}

Vec3d reflected(const Vec3d& out, const Vec3d& normal) { return normal * (2 * dot(normal, out)) - out; }

/// Boxes of directions, equal in height and turn.
constexpr int rings = 64, sectors = 32;

std::size_t box_of(const Vec3d& in) {
  const double turn = std::atan2(in.y, in.x) / (2 * pi) + 0.5;
  const int ring = std::min(static_cast<int>((in.z + 1) / 2 * rings), rings - 1);
  return static_cast<std::size_t>(ring * sectors + std::min(static_cast<int>(turn * sectors), sectors - 1));
}

/// The share of directions in each, by a density.
std::vector<double> shares(double alpha, const Vec3d& out) {
  constexpr int fine = 12;
  std::vector<double> share(rings * sectors);
  for (int ring = 0; ring < rings * fine; ++ring) {
    for (int sector = 0; sector < sectors * fine; ++sector) {
      const Vec3d in = direction_at(2 * (ring + 0.5) / (rings * fine) - 1, 2 * pi * ((sector + 0.5) / (sectors * fine) - 0.5));
      share[box_of(in)] += density(alpha, out, in) * 4 * pi / (rings * sectors * fine * fine);
    }
  }
  return share;
}

/// By how many standard deviations chi-square is more than its mean; boxes that expect few count as one.
double excess(const std::vector<int>& found, const std::vector<double>& share, int draws) {
  double chi_square = 0, rare_expected = 0, rare_found = 0;
  int freedom = 0;
  const auto add = [&](double expected, double count) {
    chi_square += (count - expected) * (count - expected) / expected;
    ++freedom;
  };
  for (std::size_t box = 0; box < share.size(); ++box) {
    const double expected = share[box] * draws;
    if (expected < 8) {
      rare_expected += expected, rare_found += found[box];
    } else {
      add(expected, found[box]);
    }
  }
  if (rare_expected > 8) {
    add(rare_expected, rare_found);
  }
  return (chi_square - (freedom - 1)) / std::sqrt(2.0 * (freedom - 1));
}

}  // namespace

TEST_CASE("normals' cosines add up to 1") {
  for (const double alpha : {0.02, 0.25, 0.5, 1.0}) {
    double sum = 0;
    constexpr int steps = 20'000;
    for (int step = 0; step < steps; ++step) {
      const double cosine = std::sin(0.5 * pi * (step + 0.5) / steps), sine = std::cos(0.5 * pi * (step + 0.5) / steps);
      sum += normal_density(alpha, cosine) * cosine * 2 * pi * sine * (0.5 * pi / steps);
    }
    CHECK(sum == doctest::Approx(1).epsilon(1e-5).scale(0));
  }
}

TEST_CASE("a surface that is hardly rough hides nothing, and no direction is seen more than the other way round") {
  CHECK(microfacet_visibility(1e-9, 0.5, 0.25) == doctest::Approx(1 / (4 * 0.5 * 0.25)));
  CHECK(microfacet_visibility(0.7, 0.5, 0.25) == microfacet_visibility(0.7, 0.25, 0.5));
  CHECK(microfacet_visibility(0.7, 1, 1) == doctest::Approx(0.25));
  for (const double alpha : {0.01, 0.3, 1.0}) {
    CHECK(microfacet_visibility(alpha, 0.1, 0.2) < 1 / (4 * 0.1 * 0.2));
  }
}

TEST_CASE("what tiny mirrors reflect is nothing of them more at a right angle, and all that grazes") {
  CHECK(schlick_share(1) == 0);
  CHECK(schlick_share(0) == 1);
  CHECK(schlick_share(0.5) == 0.03125);
}

TEST_CASE("a density of directions is 1 over the sphere, below the surface and above") {
  for (const double alpha : {0.35, 0.5, 1.0}) {
    for (const double cosine : {1.0, 0.5, 0.1, 0.0}) {
      CAPTURE(alpha);
      CAPTURE(cosine);
      double sum = 0;
      for (const double share : shares(alpha, eye_at(cosine))) {
        sum += share;
      }
      CHECK(std::fabs(sum - 1) < 1e-3);
    }
  }
}

TEST_CASE("directions are as likely as their density says: a chi-square of 200,000 of them in 64 x 32 boxes") {
  for (const double alpha : {0.35, 0.5, 1.0}) {
    for (const double cosine : {0.9, 0.5, 0.1, 0.0}) {
      CAPTURE(alpha);
      CAPTURE(cosine);
      const Vec3d out = eye_at(cosine);
      std::vector<int> found(rings * sectors);
      constexpr int draws = 200'000;
      for (std::uint64_t draw = 0; draw < draws; ++draw) {
        const Vec3d normal = visible_normal(out, up, alpha, pair_of(draw));
        REQUIRE(std::fabs(length(normal) - 1) < 1e-14);
        REQUIRE(normal.z >= 0);
        REQUIRE(dot(normal, out) > -1e-9);
        ++found[box_of(reflected(out, normal))];
      }
      const double off = excess(found, shares(alpha, out), draws);
      CHECK(off < 4);  // more is less likely than 10^-4
      CHECK(off > -4);
    }
  }
}

TEST_CASE("looked at straight ahead a normal is as likely as its cosine, and in the middle of the pair it is the surface's") {
  CHECK(visible_normal(up, up, 0.3, {0.5, 0.5}) == Vec3d{0, 0, 1});
  const double corner = visible_normal(up, up, 0.3, {0.5, 1 - 0x1p-32}).z;
  CHECK(corner < 1e-3);
}

TEST_CASE("a smooth surface's normals are its own, from wherever they are seen") {
  for (const double cosine : {1.0, 0.5, 0.1}) {
    for (std::uint64_t draw = 0; draw < 100; ++draw) {
      CHECK(visible_normal(eye_at(cosine), up, 1e-6, pair_of(draw)).z > 1 - 1e-6);
    }
  }
}

}  // namespace microfacet_test
