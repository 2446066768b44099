#include "apps/lab/oracle/fan.h"

#include <doctest/doctest.h>

#include "tests/apps/lab/oracle/primitives.h"

namespace dmpc::tests::fan_test {
namespace {

using Primitives = std::vector<core::PrimitiveValues>;

/// Four triangles around the origin in the plane z = 0.
const Primitives pyramid{triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), triangle({0, 0, 0}, {0, 1, 0}, {-1, 0, 0}),
                         triangle({0, 0, 0}, {-1, 0, 0}, {0, -1, 0}), triangle({0, 0, 0}, {0, -1, 0}, {1, 0, 0})};

TEST_CASE("triangles all around a vertex close up") {
  CHECK(apps::closed_fan(ray({0, 0, -2}, {0, 0, 1}), pyramid, 0).size() == 4);
}

TEST_CASE("a vertex with one triangle missing stays open") {
  const Primitives open(pyramid.begin(), pyramid.begin() + 3);
  CHECK(apps::closed_fan(ray({0, 0, -2}, {0, 0, 1}), open, 0).empty());
}

TEST_CASE("two triangles on both sides of an edge close up, one alone and a fold do not") {
  const core::Ray at_edge = ray({0.5F, 0, -2}, {0, 0, 1});
  CHECK(apps::closed_fan(at_edge, pyramid, 0) == std::vector<std::uint32_t>{0, 3});
  CHECK(apps::closed_fan(at_edge, Primitives{pyramid[0]}, 0).empty());
  const Primitives fold{pyramid[0], triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 1})};
  CHECK(apps::closed_fan(at_edge, fold, 0).empty());
}

TEST_CASE("a ray through the middle of a triangle is near no edge") {
  CHECK(apps::closed_fan(ray({0.25F, 0.25F, -2}, {0, 0, 1}), pyramid, 0).empty());
}

TEST_CASE("triangles that touch without sharing both vertices of an edge do not close up") {
  const Primitives touching{pyramid[0], triangle({-1, 0, 0}, {2, 0, 0}, {0, -1, 0})};
  CHECK(apps::closed_fan(ray({0.5F, 0, -2}, {0, 0, 1}), touching, 0).empty());
}

TEST_CASE("a fan with the triangle that the ray starts on does not close up") {
  core::Ray leaving = ray({0, 0, -2}, {0, 0, 1});
  leaving.ignored_primitive = 2;
  CHECK(apps::closed_fan(leaving, pyramid, 0).empty());
}

TEST_CASE("a fan whose border lies within rounding of the ray does not close up") {
  Primitives narrow = pyramid;  // seen from afar, one triangle is no wider than rounding
  narrow[0] = triangle({0, 0, 0}, {1, 0x1p-26F, 0}, {-1, 0x1p-26F, 0});
  narrow[1] = triangle({0, 0, 0}, {-1, 0x1p-26F, 0}, {-1, -1, 0});
  narrow[2] = triangle({0, 0, 0}, {-1, -1, 0}, {1, -1, 0});
  narrow[3] = triangle({0, 0, 0}, {1, -1, 0}, {1, 0x1p-26F, 0});
  CHECK(apps::closed_fan(ray({0, 0, -2}, {0, 0, 1}), narrow, 2).empty());
}

}  // namespace
}  // namespace dmpc::tests::fan_test
