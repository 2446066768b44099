#include "core/picture/lights/emitter_light.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/base/sampling.h"
#include "core/database/shading/choice_tree.h"
#include "core/picture/lights/choosing.h"
#include "core/record/choice_node.h"
#include "core/record/ray.h"

namespace emitter_light_test {

using namespace dmpc::core;

namespace {

constexpr double pi = 3.14159265358979324;
constexpr int draws = 100'000;

/// Any number, by chance.
double number_of(std::uint64_t key) { return static_cast<double>(mix(key + 0x9e3779b97f4a7c15ULL) >> 32U) * 0x1p-32; }
SamplePair pair_of(std::uint64_t key) { return {number_of(2 * key), number_of(2 * key + 1)}; }

EmitterRecord triangle() {
  return {.corner = {Vec3f{-1, 0, 1}, Vec3f{1, -0.5F, 1.2F}, Vec3f{0.3F, 1.5F, 0.8F}},
          .radiance = {1, 1, 1},
          .chance = 0.25F,
          .kind = PrimitiveKind::triangle};
}
EmitterRecord ball() {
  return {.corner = {Vec3f{0.4F, -0.3F, 2}, Vec3f{0.7F, 0, 0}, Vec3f{}},
          .radiance = {1, 1, 1},
          .chance = 0.25F,
          .kind = PrimitiveKind::sphere};
}

double chi_square(const std::vector<int>& found) {
  const double expected = double{draws} / static_cast<double>(found.size());
  double sum = 0;
  for (const int count : found) {
    sum += (count - expected) * (count - expected) / expected;
  }
  return sum;
}

/// By A. Van Oosterom, J. Strackee, "The Solid Angle of a Plane Triangle", 1983.
double solid_angle(const EmitterRecord& of) {
  const Vec3d a = normalize(Vec3d(of.corner[0])), b = normalize(Vec3d(of.corner[1])), c = normalize(Vec3d(of.corner[2]));
  return 2 * std::atan2(std::fabs(dot(a, cross(b, c))), 1 + dot(a, b) + dot(b, c) + dot(c, a));
}

}  // namespace

TEST_CASE("the mean of one over the density, over all that is drawn, is the solid angle of an emitter over its chance") {
  for (const EmitterRecord& emitter : {triangle(), ball()}) {
    const bool is_ball = emitter.kind == PrimitiveKind::sphere;
    const double square = is_ball ? 0.49 / dot(emitter.center(), emitter.center()) : 0;
    const double exact = is_ball ? 2 * pi * (1 - std::sqrt(1 - square)) : solid_angle(emitter);
    double sum = 0;
    for (std::uint64_t i = 0; i < draws; ++i) {
      const auto place = aim_at(emitter, {}, pair_of(i));
      REQUIRE(place);
      REQUIRE(std::fabs(length(place->towards) - 1) < 1e-12);
      sum += 1 / place->density;
    }
    CHECK(sum / draws == doctest::Approx(exact / 0.25).epsilon(is_ball ? 1e-6 : 0.01).scale(0));
  }
}

TEST_CASE(
    "places on a triangle are as likely as their area, and directions to a ball anywhere in its cone: chi-squares of 10^5") {
  constexpr int bins = 128;
  std::vector<int> on_triangle(bins), on_ball(bins);
  const EmitterRecord flat = triangle(), round = ball();
  const Vec3d corner(flat.corner[0]), edge1 = Vec3d(flat.corner[1]) - corner, edge2 = Vec3d(flat.corner[2]) - corner;
  const Vec3d normal = cross(edge1, edge2), axis = normalize(round.center());
  const Vec3d aside = normalize(cross(axis, {1, 0, 0})), other = cross(axis, aside);
  const double less = 1 - std::sqrt(1 - 0.49 / dot(round.center(), round.center()));
  for (std::uint64_t i = 0; i < draws; ++i) {
    const auto place = aim_at(flat, {}, pair_of(i));
    const Vec3d at = place->towards * place->distance - corner;
    const double u = dot(cross(at, edge2), normal) / dot(normal, normal), v = dot(cross(edge1, at), normal) / dot(normal, normal);
    REQUIRE(u + v <= 1 + 1e-9);
    const double ring = (u + v) * (u + v), turn = v / std::max(u + v, 1e-300);  // both as likely anywhere
    ++on_triangle[static_cast<std::size_t>(std::min(static_cast<int>(ring * 8), 7) * 16 +
                                           std::min(static_cast<int>(turn * 16), 15))];
    const Vec3d towards = aim_at(round, {}, pair_of(i + draws))->towards;
    const double share = (1 - dot(towards, axis)) / less,
                 angle = std::atan2(dot(towards, other), dot(towards, aside)) / (2 * pi) + 0.5;
    REQUIRE(share <= 1 + 1e-9);
    ++on_ball[static_cast<std::size_t>(std::min(static_cast<int>(share * 8), 7) * 16 +
                                       std::min(static_cast<int>(angle * 16), 15))];
  }
  for (const std::vector<int>* const found : {&on_triangle, &on_ball}) {
    CHECK(chi_square(*found) < 200);  // of 127 degrees of freedom more is less likely than 10^-4
    CHECK(chi_square(*found) > 70);
  }
}

TEST_CASE("who aims and who is met reckon with one density: that by area, turned to steradians, is the one that is drawn by") {
  const EmitterRecord flat = triangle(), round = ball();
  const double area = length(cross(Vec3d(flat.corner[1] - flat.corner[0]), Vec3d(flat.corner[2] - flat.corner[0]))) / 2;
  for (std::uint64_t i = 0; i < 100; ++i) {
    const auto place = aim_at(flat, {0.1, 0.2, -0.3}, pair_of(i));
    CHECK(density_towards_triangle(0.25 / area, place->distance, place->cosine) ==
          doctest::Approx(place->density).epsilon(1e-6).scale(0));
    const auto at = aim_at(round, {0.1, 0.2, -0.3}, pair_of(i));
    const double distance = length(round.center() - Vec3d{0.1, 0.2, -0.3});
    CHECK(density_towards_sphere(0.25 / (4 * pi * 0.49), distance, round.radius()) ==
          doctest::Approx(at->density).epsilon(1e-6).scale(0));
    const Vec3d on_ball = Vec3d{0.1, 0.2, -0.3} + at->towards * at->distance - round.center();
    CHECK(length(on_ball) == doctest::Approx(round.radius()).epsilon(1e-9).scale(0));
    CHECK(at->cosine == doctest::Approx(-dot(on_ball, at->towards) / round.radius()).epsilon(1e-6).scale(0));
  }
}

TEST_CASE("nobody aims at a ball from within, nor at a triangle that is seen edge-on") {
  CHECK(!aim_at(ball(), {0.4, -0.3, 2.1}, {0.5, 0.5}));
  CHECK(density_towards_sphere(1, 0.5, 0.7) == 0);
  EmitterRecord flat = triangle();
  flat.corner = {Vec3f{0, 0, 0}, Vec3f{1, 0, 0}, Vec3f{0, 1, 0}};
  CHECK(!aim_at(flat, {5, 5, 0}, {0.5, 0.5}));
}

TEST_CASE("shares of two ways that might have brought the same light add up to all of it, also where one of them must have") {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  for (const double own : {1e-30, 0.3, 7.0, 1e30}) {
    for (const double other : {1e-20, 0.5, 1e20}) {
      CHECK(way_share(own, other) + way_share(other, own) == doctest::Approx(1).epsilon(1e-15).scale(0));
    }
    CHECK(way_share(infinite, own) == 1);
    CHECK(way_share(own, infinite) == 0);
    CHECK(way_share(own, 0) == 1);
    CHECK(way_share(0, own) == 0);
  }
}

TEST_CASE("a density travels in 16 bits, rounded to 1 in 256, and none of them is infinity") {
  for (double density = 1e-30; density < 1e30; density *= 1.37) {
    CHECK(density_of(density_bits(density)) == doctest::Approx(density).epsilon(1.0 / 256).scale(0));
    CHECK(density_bits(density_of(density_bits(density))) == density_bits(density));
  }
  CHECK(density_bits(0) != 0);
  CHECK(density_bits(std::numeric_limits<double>::infinity()) == 0);
  CHECK(density_bits(1e300) == 0);
  CHECK(density_of(0) == std::numeric_limits<double>::infinity());
}

TEST_CASE("a tree selects each choice as often as its weight says, to within one of all numbers, and each evenly") {
  for (const std::size_t count : {1U, 2U, 7U, 8U, 13U, 14U, 100U}) {
    CAPTURE(count);
    std::vector<double> weights;
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) {
      weights.push_back(i % 7 == 3 ? 1e-5 : i % 5 == 1 ? 7 : 0.3);
      sum += weights.back();
    }
    const std::vector<ChoiceNode> tree = choice_tree(weights);
    REQUIRE(tree.size() == choice_node_count(static_cast<std::uint32_t>(count)));
    std::vector<int> found(count);
    std::vector<double> places(count);
    constexpr int many = 1 << 18;
    for (int i = 0; i < many; ++i) {
      const DrawnEmitter drawn = drawn_from(tree, static_cast<std::uint32_t>(count), (i + 0.5) / many, 0.5);
      REQUIRE(drawn.place >= 0);
      REQUIRE(drawn.place < 1);
      REQUIRE(drawn.index < count);
      ++found[drawn.index];
      places[drawn.index] += double{drawn.place};
    }
    for (std::size_t i = 0; i < count; ++i) {
      CHECK(std::fabs(found[i] - many * weights[i] / sum) <= 1);
      if (found[i] > 1000) {
        CHECK(places[i] / found[i] == doctest::Approx(0.5).epsilon(0.01).scale(0));
      }
    }
  }
}

TEST_CASE("the largest number selects the last choice, and the way there keeps node and number") {
  const std::vector<double> weights(50, 1.0);
  const std::vector<ChoiceNode> tree = choice_tree(weights);
  const double last = 1 - 0x1p-32;
  CHECK(step_of(tree[0], last).child == 6);
  const DrawnEmitter drawn = drawn_from(tree, 50, last, last);
  CHECK(drawn.place > 0.99F);
  const Choosing at{0xabcdef, 1 - 0x1p-40}, kept = Choosing::from(at.stored());
  CHECK(kept.node == at.node);
  CHECK(kept.number == at.number);
}

}  // namespace emitter_light_test
