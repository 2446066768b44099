#include "apps/lab/oracle/reference/samples.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>

namespace dmpc::tests::samples_test {
namespace {

using apps::SamplePattern;

TEST_CASE("one sample of the product lies in the pixel's centre") {
  const SamplePattern pattern = SamplePattern::of_product(1);
  CHECK(pattern.count() == 1);
  CHECK(pattern.position(17, 0).column == 0);
  CHECK(pattern.position(17, 0).row == 0);
}

TEST_CASE("stratified samples lie one in each cell") {
  const SamplePattern pattern = SamplePattern::stratified(4, 3, 1);
  std::array<int, 12> cells{};
  for (std::uint32_t sample = 0; sample < pattern.count(); ++sample) {
    const apps::SamplePosition at = pattern.position(5, sample);
    REQUIRE(std::fabs(at.column) <= 0.5);
    REQUIRE(std::fabs(at.row) <= 0.5);
    ++cells[static_cast<std::size_t>(std::floor((at.row + 0.5) * 3)) * 4 + static_cast<std::size_t>((at.column + 0.5) * 4)];
  }
  for (const int count : cells) {
    CHECK(count == 1);
  }
}

TEST_CASE("stratified samples have the mean and the spread of their cells") {
  const SamplePattern pattern = SamplePattern::stratified(1, 1, 3);
  double sum = 0, squares = 0;
  for (std::uint32_t pixel = 0; pixel < 20000; ++pixel) {
    const double column = pattern.position(pixel, 0).column;
    sum += column / 20000, squares += column * column / 20000;
  }
  CHECK(std::fabs(sum) < 0.01);
  CHECK(squares == doctest::Approx(1.0 / 12).epsilon(0.03));
}

TEST_CASE("other seeds and other pixels give other samples") {
  const SamplePattern one = SamplePattern::stratified(2, 2, 1), two = SamplePattern::stratified(2, 2, 2);
  CHECK(one.position(0, 0).column != two.position(0, 0).column);
  CHECK(one.position(0, 0).column != one.position(1, 0).column);
  CHECK(one.position(0, 0).column == SamplePattern::stratified(2, 2, 1).position(0, 0).column);
}

TEST_CASE("a pattern without samples is refused") { CHECK_THROWS_AS(SamplePattern::stratified(0, 2, 1), core::InternalError); }

}  // namespace
}  // namespace dmpc::tests::samples_test
