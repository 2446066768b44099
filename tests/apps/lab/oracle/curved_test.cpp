#include "apps/oracle/curved.h"

#include <doctest/doctest.h>

#include "tests/apps/lab/oracle/primitives.h"

namespace dmpc::tests::curved_test {
namespace {

double distance_to(const core::PrimitiveValues& values, const core::Ray& from) {
  return apps::nearest_on_curved(values, from).value_or(-1);
}

TEST_CASE("a ray at a unit sphere's centre meets it one radius early") {
  CHECK(distance_to(sphere({0, 0, 0}, 1), ray({0, 0, -3}, {0, 0, 1})) == 2);
}

TEST_CASE("a ray from inside a sphere meets its far side") {
  CHECK(distance_to(sphere({0, 0, 0}, 1), ray({0, 0, 0.5F}, {0, 0, 1})) == 0.5);
}

TEST_CASE("a ray beside a sphere, behind it or too short misses it") {
  CHECK(distance_to(sphere({0, 0, 0}, 1), ray({1.5F, 0, -3}, {0, 0, 1})) == -1);
  CHECK(distance_to(sphere({0, 0, 0}, 1), ray({0, 0, 3}, {0, 0, 1})) == -1);
  CHECK(distance_to(sphere({0, 0, 0}, 1), shadow_ray({0, 0, -3}, {0, 0, 1}, 2)) == -1);
}

TEST_CASE("a negative radius shows the inside only") {
  CHECK(distance_to(sphere({0, 0, 0}, -1), ray({0, 0, -3}, {0, 0, 1})) == 4);
  CHECK(distance_to(cone({0, 0, 0}, -1, {0, 2, 0}, -1), ray({0, 1, -3}, {0, 0, 1})) == 4);
}

TEST_CASE("a ray across a cylinder meets its wall, a ray along its axis passes through the open ends") {
  const auto cylinder = cone({0, 0, 0}, 1, {0, 2, 0}, 1);
  CHECK(distance_to(cylinder, ray({0, 1, -3}, {0, 0, 1})) == 2);
  CHECK(distance_to(cylinder, ray({0, -5, 0}, {0, 1, 0})) == -1);
}

TEST_CASE("a ray through a cylinder's open end meets the wall from inside") {
  const auto cylinder = cone({0, 0, 0}, 1, {0, 2, 0}, 1);
  CHECK(distance_to(cylinder, ray({0, -1, 0}, {0.6F, 0.8F, 0})) == doctest::Approx(1 / 0.6).epsilon(1e-6));
}

TEST_CASE("a ray above or below a cylinder's ends misses it") {
  const auto cylinder = cone({0, 0, 0}, 1, {0, 2, 0}, 1);
  CHECK(distance_to(cylinder, ray({0, 2.001F, -3}, {0, 0, 1})) == -1);
  CHECK(distance_to(cylinder, ray({0, -0.001F, -3}, {0, 0, 1})) == -1);
}

TEST_CASE("a cone's mirror nappe behind its apex is not there") {
  const auto pointed = cone({0, 0, 0}, 1, {0, 1, 0}, 0);
  CHECK(distance_to(pointed, ray({0, 0.5F, -3}, {0, 0, 1})) == 2.5);
  CHECK(distance_to(pointed, ray({0, 1.5F, -3}, {0, 0, 1})) == -1);
}

TEST_CASE("a ray parallel to a cone's wall meets the other wall") {
  CHECK(distance_to(cone({0, 0, 0}, 1, {0, 1, 0}, 0), ray({-2, 0, 0}, {0.70710678F, 0.70710678F, 0})) == -1);
  CHECK(distance_to(cone({0, 0, 0}, 1, {0, 1, 0}, 0), ray({-1, -0.5F, 0}, {0.70710678F, 0.70710678F, 0})) ==
        doctest::Approx(1.25 * 1.41421356).epsilon(1e-6));
}

TEST_CASE("the box of a primitive holds its whole surface") {
  const auto box = apps::bounds_of_curved(cone({0, 0, 0}, 1, {0, 2, 0}, 0.5F));
  CHECK((box[0] <= -1 && box[1] <= 0 && box[2] <= -1));
  CHECK((box[3] >= 1 && box[4] >= 2 && box[5] >= 1));
  const auto inside_out = apps::bounds_of_curved(sphere({1, 1, 1}, -1));
  CHECK((inside_out[0] <= 0 && inside_out[3] >= 2));
}

}  // namespace
}  // namespace dmpc::tests::curved_test
