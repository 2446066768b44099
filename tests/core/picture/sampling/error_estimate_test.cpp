#include "core/picture/sampling/error_estimate.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdint>

#include "core/picture/film/film.h"
#include "core/picture/sampling/sample_pass.h"

namespace error_estimate_test {

using namespace dmpc::core;

namespace {

/// Gray light of one of a pixel's planes, the sum of what two floats hold.
FixedColor gray(double light) {
  const auto whole = static_cast<float>(std::floor(light)), rest = static_cast<float>(light - std::floor(light));
  FixedColor sum = to_fixed({whole, whole, whole});
  add(sum, to_fixed({rest, rest, rest}));
  return sum;
}

/// A square picture of which every pixel has two samples, and an estimate by these.
class Picture {
 public:
  explicit Picture(int side)
      : film_(side, side), pass_(static_cast<std::uint32_t>(side * side), 2), estimate_(side, side, nullptr, 0) {}

  std::uint32_t pixel_count() const { return static_cast<std::uint32_t>(film_.pixel_count()); }
  void shine(std::uint32_t pixel, const std::array<double, 2>& light) {
    film_.deposit(pixel, {{gray(light[0]), gray(light[1])}});
  }
  /// Ends the pass under way.
  void estimate() {
    for (std::uint32_t pixel = 0; pixel < pixel_count(); ++pixel) {
      film_.add_samples(pixel, pass_.samples(pixel).count);
    }
    estimate_.end_pass(film_, pass_);
  }
  /// Begins with another, in which all samples double so often.
  void go_on(std::uint32_t doublings) {
    for (std::uint32_t pixel = 0; pixel < pixel_count(); ++pixel) {
      film_.gather_planes(pixel);
      pass_.steps()[pixel] = {pass_.steps()[pixel].to(), pass_.steps()[pixel].to() + doublings};
    }
    estimate_.begin_pass();
  }
  double error(std::uint32_t pixel) const { return std::sqrt(estimate_.square_error(film_, pixel)); }

 private:
  Film film_;
  Pass pass_;
  ErrorEstimate estimate_;
};

}  // namespace

TEST_CASE("one highlight among 10,000 pixels that tell does not decide how fast the errors of all fall") {
  Picture picture(100);
  const auto light_of = [](std::uint32_t pixel) { return pixel == 9999 ? 1000.0 : 1.0; };
  for (std::uint32_t pixel = 0; pixel < 10000; ++pixel) {
    picture.shine(pixel, {light_of(pixel), light_of(pixel)});
  }
  picture.estimate();
  picture.go_on(2);
  for (std::uint32_t pixel = 0; pixel < 10000; ++pixel) {
    // The mean of all eight samples is higher by a change than that of two, and by 0.1 than that of four: as edges make it, but
    // as chance makes it in the highlight.
    const double change = pixel == 9999 ? 0.1 * std::sqrt(3.0) : 0.1 * std::sqrt(std::exp2(1.5) + 1);
    const double first_four = 4 * (1 + change - 0.1), all = 8 * (1 + change);
    picture.shine(pixel, {light_of(pixel) * (first_four - 2), light_of(pixel) * (all - first_four)});
  }
  picture.estimate();
  // Edges make the error 0.1 / sqrt(2^1.5 - 1), chance 0.1.
  CHECK(picture.error(0) == doctest::Approx(0.1 / std::sqrt(std::exp2(1.5) - 1)).scale(0).epsilon(0.03));
}

TEST_CASE("a change is seen that is far less than what a float tells of a bright pixel") {
  const double change = 1.0 / 16384;  // an eighth of a float's last place at 4096
  Picture first(1);
  first.shine(0, {4096, 4096 + 2 * change});
  first.estimate();
  CHECK(first.error(0) == doctest::Approx(change / std::sqrt(1.5)).scale(0));
  for (const std::uint32_t doublings : {1U, 2U}) {
    CAPTURE(doublings);
    Picture later(1);
    later.shine(0, {4096, 4096});
    later.estimate();
    CHECK(later.error(0) == 0);
    later.go_on(doublings);
    later.shine(0, doublings == 1 ? std::array{8192 + 4 * change, 0.0} : std::array{8192.0, 16384 + 8 * change});
    later.estimate();
    CHECK(later.error(0) == doctest::Approx(change / std::sqrt(1.5)).scale(0).epsilon(0.02));
  }
}

}  // namespace error_estimate_test
