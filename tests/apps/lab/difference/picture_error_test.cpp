#include "apps/lab/difference/picture_error.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "core/base/expect.h"
#include "tests/support/gray.h"

namespace dmpc::apps::picture_error_test {

using tests::gray;

TEST_CASE("a picture does not differ from itself") {
  const PictureError error = measure_error(gray(4, 3, 0.5F), gray(4, 3, 0.5F));
  CHECK(error.root_mean_square == 0);
  CHECK(error.largest == 0);
  CHECK(error.mean_absolute == 0);
  CHECK(error.relative_mean_square == 0);
  CHECK(std::isinf(error.peak_signal_to_noise_decibels));
  CHECK(error.pixels == 12);
  CHECK(error.differing_pixels == 0);
}

TEST_CASE("pictures a constant apart have that constant as every error") {
  const PictureError error = measure_error(gray(2, 2, 0.75F), gray(2, 2, 0.25F));
  CHECK(error.root_mean_square == doctest::Approx(0.5));
  CHECK(error.largest == doctest::Approx(0.5));
  CHECK(error.mean_absolute == doctest::Approx(0.5));
  CHECK(error.relative_mean_square == doctest::Approx(0.25 / (0.26 * 0.26)));
  CHECK(error.peak_signal_to_noise_decibels == doctest::Approx(6.0206));
  CHECK(error.differing_pixels == 4);
}

TEST_CASE("one channel of one pixel counts as one differing pixel") {
  Image picture = gray(10, 10, 1);
  picture.rgb[31] = 2;
  const PictureError error = measure_error(picture, gray(10, 10, 1));
  CHECK(error.differing_pixels == 1);
  CHECK(error.largest == 1);
  CHECK(error.mean_absolute == doctest::Approx(1.0 / 300));
}

TEST_CASE("values that are not finite make the errors infinite and never NaN") {
  const float infinity = std::numeric_limits<float>::infinity();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const float value : {infinity, -infinity, nan}) {
    const PictureError error = measure_error(gray(1, 1, value), gray(1, 1, 0));
    CHECK(std::isinf(error.root_mean_square));
    CHECK(std::isinf(error.relative_mean_square));
    CHECK(measure_error(gray(1, 1, value), gray(1, 1, value)).differing_pixels == 0);
  }
}

TEST_CASE("pictures of different sizes are refused") {
  CHECK_THROWS_WITH_AS(measure_error(gray(4, 3, 0), gray(3, 4, 0)),
                       "the pictures differ in size, 4x3 and 3x4: only pictures of one size can be compared", core::InputError);
}

TEST_CASE("the difference picture holds the absolute differences") {
  const Image difference = difference_picture(gray(2, 1, 0.25F), gray(2, 1, 1));
  CHECK(difference.rgb == gray(2, 1, 0.75F).rgb);
}

TEST_CASE("the 99th percentile is the largest error once a hundredth of the pixels are apart") {
  Image picture = gray(10, 10, 1);
  picture.rgb[31] = 2;
  CHECK(measure_error(picture, gray(10, 10, 1)).percentile_99 == 0);
  picture.rgb[60] = 1.5F;
  CHECK(measure_error(picture, gray(10, 10, 1)).percentile_99 == 0.5);
  CHECK(measure_error(gray(1, 1, 3), gray(1, 1, 1)).percentile_99 == 2);
  CHECK(measure_error(gray(0, 0, 3), gray(0, 0, 1)).percentile_99 == 0);
}

TEST_CASE("the perceived error is there as a mean, a percentile and a picture") {
  const PictureError error = measure_error(gray(8, 8, 1), gray(8, 8, 0));
  CHECK(error.flip_mean == doctest::Approx(error.flip_percentile_99));
  CHECK(flip_picture(gray(8, 8, 1), gray(8, 8, 0)).rgb[17] == doctest::Approx(error.flip_mean));
}

}  // namespace dmpc::apps::picture_error_test
