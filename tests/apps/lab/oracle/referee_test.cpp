#include "apps/lab/oracle/referee.h"

#include <doctest/doctest.h>

#include <limits>

#include "tests/apps/lab/oracle/primitives.h"

namespace dmpc::tests::referee_test {
namespace {

using apps::Answer;
using apps::Referee;
using apps::Verdict;
using Primitives = std::vector<core::PrimitiveValues>;

Answer hit(std::uint32_t id) { return {true, id, 0}; }
const Answer nothing{};

core::PrimitiveValues square_half(float z, bool upper) {
  return upper ? triangle({-1, -1, z}, {1, 1, z}, {-1, 1, z}) : triangle({-1, -1, z}, {1, -1, z}, {1, 1, z});
}

TEST_CASE("in an empty world a miss is right and a hit is wrong") {
  const Referee referee(Primitives{});
  CHECK_FALSE(referee.exact(ray({0, 0, 0}, {0, 0, 1})).hit);
  CHECK(referee.admissible(ray({0, 0, 0}, {0, 0, 1}), nothing, apps::Renderer::grid));
}

TEST_CASE("the nearest of several is the exact answer, whatever their order") {
  const Primitives world{square_half(3, false), sphere({0.5F, 0, 1}, 0.25F), square_half(2, false)};
  CHECK(Referee(world).exact(ray({0.5F, 0, -1}, {0, 0, 1})) == hit(1));
  CHECK(Referee(world).exact(ray({0.9F, -0.5F, -1}, {0, 0, 1})) == hit(2));
}

TEST_CASE("a grid that names the farther of two clear hits is wrong") {
  const Primitives world{square_half(3, false), square_half(2, false)};
  const auto ruling = Referee(world).settle(ray({0.5F, 0, -1}, {0, 0, 1}), hit(0), hit(1));
  CHECK(ruling.verdict == Verdict::grid_wrong);
  CHECK((!ruling.favours_grid && ruling.favours_oracle));
  CHECK_FALSE(explained(ruling.verdict));
}

TEST_CASE("an oracle that misses a clear hit is wrong, and both may be") {
  const Primitives world{square_half(2, false)};
  const Referee referee(world);
  CHECK(referee.settle(ray({0.5F, 0, -1}, {0, 0, 1}), hit(0), nothing).verdict == Verdict::oracle_wrong);
  CHECK(referee.settle(ray({-0.5F, 0, -1}, {0, 0, 1}), hit(0), hit(0)).verdict == Verdict::both_wrong);
}

TEST_CASE("two coincident triangles are a tie and exactly the lower id") {
  const Primitives world{square_half(2, false), square_half(2, false)};
  const auto ruling = Referee(world).settle(ray({0.5F, 0, -1}, {0, 0, 1}), hit(1), hit(0));
  CHECK(ruling.verdict == Verdict::tie);
  CHECK((ruling.favours_oracle && ruling.exact == hit(0)));
}

TEST_CASE("two triangles a hundred-thousandth apart at distance one are not a tie") {
  const Primitives world{square_half(1, false), square_half(1 + 1e-5F, false)};
  CHECK(Referee(world).settle(ray({0.5F, 0, 0}, {0, 0, 1}), hit(1), hit(0)).verdict == Verdict::grid_wrong);
}

TEST_CASE("the border of a lone triangle is a silhouette for a hit and for a miss") {
  const Primitives world{square_half(2, false)};
  const core::Ray brushing = ray({1, 0, -1}, {0, 0, 1});
  CHECK(Referee(world).settle(brushing, hit(0), nothing).verdict == Verdict::silhouette);
  CHECK(Referee(world).settle(brushing, nothing, hit(0)).verdict == Verdict::silhouette);
}

TEST_CASE("on a shared edge either triangle is explained but a miss is a leak") {
  const Primitives world{square_half(2, false), square_half(2, true)};
  const core::Ray diagonal = ray({0.3F, 0.3F, -1}, {0, 0, 1});
  CHECK(Referee(world).settle(diagonal, hit(1), hit(0)).verdict == Verdict::silhouette);
  CHECK(Referee(world).settle(diagonal, nothing, hit(0)).verdict == Verdict::grid_wrong);
  CHECK(Referee(world).settle(diagonal, hit(0), nothing).verdict == Verdict::oracle_wrong);
}

TEST_CASE("seeing the back wall through a shared edge is a leak") {
  const Primitives world{square_half(2, false), square_half(2, true), sphere({0, 0, 9}, 5)};
  CHECK(Referee(world).settle(ray({0.3F, 0.3F, -1}, {0, 0, 1}), hit(2), hit(0)).verdict == Verdict::grid_wrong);
}

TEST_CASE("what lies between the two triangles of a silhouette's edge is no leak, what lies behind both is") {
  // Next to the edge x = 0 the ray passes the left one by less than rounding, and meets the right one, seen from its side,
  // behind.
  const Primitives world{triangle({0, -1, 1}, {0, 1, 1}, {-1, 0, 1}), triangle({0, 1, 1}, {0, -1, 1}, {1e-5F, 0, 2}),
                         square_half(1.001F, false), square_half(3, false)};
  const core::Ray by_the_edge = ray({2e-8F, -0.1F, 0}, {0, 0, 1});
  const Referee referee(world);
  REQUIRE(referee.examine(by_the_edge, 0).margin[0] < 0);
  REQUIRE(referee.examine(by_the_edge, 0).possible(apps::Renderer::grid));
  REQUIRE(referee.examine(by_the_edge, 1).t > 1.001);
  CHECK(referee.exact(by_the_edge) == hit(2));
  CHECK(referee.admissible(by_the_edge, hit(2), apps::Renderer::grid));
  CHECK_FALSE(referee.admissible(by_the_edge, hit(3), apps::Renderer::grid));
  const Primitives without{world[0], world[1], square_half(9, true), world[3]};
  CHECK_FALSE(Referee(without).admissible(by_the_edge, hit(3), apps::Renderer::grid));
}

TEST_CASE("a shadow ray is judged by its bit alone") {
  const Primitives world{square_half(2, false), square_half(3, false)};
  const Referee referee(world);
  const Answer blocked{true, core::no_primitive, 0};
  const core::Ray through = shadow_ray({0.5F, 0, -1}, {0, 0, 1}, 9);
  CHECK(referee.settle(through, nothing, blocked).verdict == Verdict::grid_wrong);
  CHECK(referee.settle(through, blocked, nothing).favours_grid);
  CHECK(referee.settle(shadow_ray({0.5F, 0, -1}, {0, 0, 1}, 3), nothing, blocked).verdict == Verdict::end);
  CHECK(referee.settle(shadow_ray({0.5F, 0, -1}, {0, 0, 1}, 2), blocked, nothing).verdict == Verdict::grid_wrong);
}

TEST_CASE("the triangle that a ray starts on does not exist for it, a sphere does") {
  const Primitives world{square_half(2, false), sphere({0.5F, 0, 5}, 1)};
  core::Ray leaving = ray({0.5F, 0, -1}, {0, 0, 1});
  leaving.ignored_primitive = 0;
  CHECK(Referee(world).exact(leaving) == hit(1));
  leaving.ignored_primitive = 1;
  leaving.origin.z = 5;
  CHECK(Referee(world).exact(leaving) == hit(1));
}

TEST_CASE("rays that are not finite miss") {
  const Primitives world{square_half(2, false)};
  const float infinity = std::numeric_limits<float>::infinity();
  CHECK_FALSE(Referee(world).exact(ray({0, infinity, 0}, {0, 0, 1})).hit);
  CHECK_FALSE(Referee(world).exact(ray({0, 0, 0}, {0, 0, std::numeric_limits<float>::quiet_NaN()})).hit);
  CHECK_FALSE(Referee(world).exact(ray({0, 0, 0}, {0, 0, 0})).hit);
}

}  // namespace
}  // namespace dmpc::tests::referee_test
