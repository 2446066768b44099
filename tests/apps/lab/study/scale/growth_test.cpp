#include "apps/lab/study/scale/figures.h"

#include <doctest/doctest.h>

#include <cmath>
#include <utility>
#include <vector>

namespace dmpc::tests::growth_test {

using Points = std::vector<std::pair<double, double>>;

namespace {

Points power_law(double factor, double exponent) {
  Points points;
  for (const double x : {1e3, 4e3, 1.6e4, 1e7}) {
    points.emplace_back(x, factor * std::pow(x, exponent));
  }
  return points;
}

}  // namespace

TEST_CASE("the exponent of a power law is found whatever its factor") {
  for (const double exponent : {-0.5, 0.0, 1.0, 1.25, 2.0}) {
    for (const double factor : {1e-6, 1.0, 3e5}) {
      CHECK(apps::growth_exponent(power_law(factor, exponent)) == doctest::Approx(exponent).epsilon(1e-9));
    }
  }
}

TEST_CASE("the exponent lies between those of the parts that a curve has") {
  const Points points = {{1, 1}, {10, 10}, {100, 1000}};
  CHECK(apps::growth_exponent(points) == doctest::Approx(1.5));
}

TEST_CASE("points that have no logarithm do not count") {
  Points points = power_law(2, 1.5);
  points.insert(points.end(), {{5e3, 0}, {0, 5}, {-1, 1}, {7e3, -2}});
  CHECK(apps::growth_exponent(points) == doctest::Approx(1.5).epsilon(1e-9));
}

TEST_CASE("without two different places there is no growth") {
  CHECK_FALSE(apps::growth_exponent(Points{}));
  CHECK_FALSE(apps::growth_exponent(Points{{3, 4}}));
  CHECK_FALSE(apps::growth_exponent(Points{{3, 4}, {3, 5}, {3, 6}}));
  CHECK_FALSE(apps::growth_exponent(Points{{3, 4}, {4, 0}}));
  CHECK(apps::growth_exponent(Points{{3, 4.1}, {4, 4.1}, {9, 4.1}}) == 0);
}

}  // namespace dmpc::tests::growth_test
