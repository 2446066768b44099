// Adaptive sampling of light along paths, whose error is noise.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>

#include "core/base/sampling.h"
#include "core/picture/sampling/refinement.h"

namespace noisy_refinement_test {

using namespace dmpc::core;

namespace {

/// From 0 to 1, the sample's own.
double chance(std::uint32_t pixel, std::uint32_t sample, std::uint64_t seed) {
  return static_cast<double>(mix(mix((std::uint64_t{pixel} << 32U | sample) + (seed << 52U)) + 0x9e3779b97f4a7c15ULL) >> 11U) *
         0x1p-53;
}

/// A picture of pixels whose samples bring light(chance), refined until the estimate is below an error.
struct Picture {
  static constexpr int side = 64;
  static constexpr std::uint32_t first = first_refined_samples(ErrorKind::noise);

  template <class Light>
  Picture(double asked, const Light& light, std::uint64_t seed = 0)
      : film(side, side), refinement({.error = asked, .kind = ErrorKind::noise}, first, side, side) {
    do {
      for (std::uint32_t pixel = 0; pixel < film.pixel_count(); ++pixel) {
        const SampleRange samples = refinement.pass().samples(pixel);
        for (std::uint32_t sample = samples.first; sample < samples.first + samples.count; ++sample) {
          const auto found = static_cast<float>(light(chance(pixel, sample, seed)));
          PixelSums sums;
          add(sums.plane[plane_of(sample)], to_fixed({found, found, found}));
          film.deposit(pixel, sums);
        }
      }
    } while (refinement.next_pass(film));
  }

  double mean() const {
    double sum = 0;
    for (std::uint32_t pixel = 0; pixel < film.pixel_count(); ++pixel) {
      sum += film.radiance(pixel).x;
    }
    return sum / static_cast<double>(film.pixel_count());
  }
  double error(double truth) const {
    double squares = 0;
    for (std::uint32_t pixel = 0; pixel < film.pixel_count(); ++pixel) {
      squares += (film.radiance(pixel).x - truth) * (film.radiance(pixel).x - truth);
    }
    return std::sqrt(squares / static_cast<double>(film.pixel_count()));
  }

  Film film;
  Refinement refinement;
};

/// By the sums of twelve chances, which are next to normal.
double log_normal(double chance) {
  double sum = -6;
  auto bits = static_cast<std::uint64_t>(chance * 0x1p53);
  for (int i = 0; i < 12; ++i) {
    bits = mix(bits + 0x632be59bd9b4e019ULL);
    sum += static_cast<double>(bits >> 11U) * 0x1p-53;
  }
  return std::exp(1.5 * sum);
}

}  // namespace

TEST_CASE("of noise all pixels get eight samples and eight more before anything is told of an error") {
  Film film(5, 4);
  Refinement refinement({.error = 1e-3, .kind = ErrorKind::noise}, 8, 5, 4);
  CHECK(refinement.pass().samples(3) == SampleRange{0, 8});
  REQUIRE(refinement.next_pass(film));
  CHECK(refinement.result().error == 0);
  CHECK(refinement.pass().pixel_count() == 20);
  CHECK(refinement.pass().samples(3) == SampleRange{8, 8});
  CHECK_FALSE(refinement.next_pass(film));
  CHECK(refinement.result().passes == 2);
  CHECK(film.samples(3) == 16);
}

TEST_CASE("black and white at random is refined to the error asked for, and stays as bright as it is") {
  const Picture picture(0.05, [](double chance) { return chance < 0.5 ? 0.0 : 1.0; });
  CHECK(picture.error(0.5) == doctest::Approx(picture.refinement.result().error).epsilon(0.15));
  CHECK(picture.refinement.result().error <= 0.05);
  CHECK(picture.mean() == doctest::Approx(0.5).epsilon(0.01));
}

TEST_CASE("what is often dim and rarely bright is no more than 1.5 % darker, and its error at most 1.4 times the one asked for") {
  const double mean = std::exp(1.5 * 1.5 / 2);
  const Picture picture(0.1, log_normal);
  CHECK(picture.mean() == doctest::Approx(mean).epsilon(0.015));
  CHECK(picture.error(mean) < 1.4 * 0.1);
  CHECK(picture.error(mean) > 0.7 * 0.1);
}

TEST_CASE("loose errors leave the mean of many pictures as it is, as far as 0.5 %") {
  constexpr int seeds = 32;
  // The mean of exp(x) where x is the sum of twelve numbers from 0 to 1, less 6.
  const double light = std::pow(2 * std::sinh(0.5), 12);
  for (const double asked : {0.33, 0.16}) {
    double sum = 0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      sum += Picture(
                 asked, [](double chance) { return std::pow(log_normal(chance), 1 / 1.5); }, seed)
                 .mean();
    }
    CAPTURE(asked);
    CHECK(sum / seeds == doctest::Approx(light).epsilon(0.005));
  }
}

TEST_CASE("what one sample in a hundred finds is not missed, though most pixels have met none of it") {
  const Picture picture(0.1, [](double chance) { return chance < 0.01 ? 20.2 : 0.2; });
  CHECK(picture.mean() == doctest::Approx(0.4).epsilon(0.015));
  CHECK(picture.error(0.4) < 1.25 * 0.1);
  CHECK(picture.error(0.4) > 0.7 * 0.1);
}

}  // namespace noisy_refinement_test
