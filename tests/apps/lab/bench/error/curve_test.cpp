#include "apps/lab/bench/error/result.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "core/base/expect.h"

namespace dmpc::tests::curve_test {

using apps::cost_at;
using apps::CostPoint;
using apps::pareto_front;

namespace {

std::vector<bool> front(const std::vector<CostPoint>& points) {
  return pareto_front(points, std::vector<bool>(points.size(), true));
}

}  // namespace

TEST_CASE("the Pareto front has the points that nothing cheaper equals and nothing better undercuts") {
  CHECK(front({}).empty());
  CHECK(front({{5, 5}}) == std::vector{true});
  CHECK(front({{1, 8}, {2, 4}, {3, 5}, {4, 2}, {5, 2}, {4, 3}, {1, 9}}) ==
        std::vector{true, true, false, true, false, false, false});
}

TEST_CASE("points that are equal in cost and error are on the Pareto front together") {
  CHECK(front({{1, 2}, {1, 2}, {2, 3}}) == std::vector{true, true, false});
}

TEST_CASE("a point that is not drawn is on no Pareto front and keeps no other off it") {
  CHECK(pareto_front(std::vector<CostPoint>{{1, 1}, {2, 2}}, {false, true}) == std::vector{false, true});
  CHECK_THROWS_AS(pareto_front(std::vector<CostPoint>{{1, 1}}, {}), core::InternalError);
}

TEST_CASE("between two points the cost at an error lies on a line in logarithms") {
  const std::vector<CostPoint> slope_2 = {{400, 1}, {1, 20}, {100, 2}};
  CHECK(*cost_at(slope_2, 4) == doctest::Approx(25));
  CHECK(*cost_at(slope_2, std::sqrt(2.0)) == doctest::Approx(200));
}

TEST_CASE("the cost at the error of a point is that of the cheapest such point") {
  const std::vector<CostPoint> points = {{100, 2}, {90, 2}, {400, 1}};
  CHECK(*cost_at(points, 2) == 90);
  CHECK(*cost_at(points, 1) == 400);
  CHECK(*cost_at(std::vector<CostPoint>{{7, 3}}, 3) == 7);
}

TEST_CASE("nothing is known of the cost at an error more than a tenth outside the curve, which goes straight on so far") {
  const std::vector<CostPoint> points = {{100, 2}, {400, 1}};
  CHECK(*cost_at(points, 2 * 1.05) == doctest::Approx(100 / (1.05 * 1.05)));
  CHECK(*cost_at(points, 1 / 1.05) == doctest::Approx(400 * 1.05 * 1.05));
  CHECK_FALSE(cost_at(points, 2.21));
  CHECK_FALSE(cost_at(points, 0.9));
  CHECK_FALSE(cost_at({}, 1));
  CHECK_FALSE(cost_at(std::vector<CostPoint>{{7, 3}}, 2.9));
  CHECK_FALSE(cost_at(std::vector<CostPoint>{{0, 2}, {400, 1}, {9, 0}}, 1.5));
}

}  // namespace dmpc::tests::curve_test
