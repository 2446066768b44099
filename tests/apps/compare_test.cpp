#include "apps/compare.h"

#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "core/expect.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::apps {

namespace {

Image gray(int width, int height, float value) {
  Image image(width, height);
  image.rgb.assign(image.rgb.size(), value);
  return image;
}

}  // namespace

TEST_CASE("a picture does not differ from itself") {
  const Difference difference = measure_difference(gray(4, 3, 0.5F), gray(4, 3, 0.5F));
  CHECK(difference.root_mean_square == 0);
  CHECK(difference.largest == 0);
  CHECK(difference.mean_absolute == 0);
  CHECK(difference.relative_mean_square == 0);
  CHECK(std::isinf(difference.peak_signal_to_noise_decibels));
  CHECK(difference.pixels == 12);
  CHECK(difference.differing_pixels == 0);
}

TEST_CASE("pictures a constant apart have that constant as every error") {
  const Difference difference = measure_difference(gray(2, 2, 0.75F), gray(2, 2, 0.25F));
  CHECK(difference.root_mean_square == doctest::Approx(0.5));
  CHECK(difference.largest == doctest::Approx(0.5));
  CHECK(difference.mean_absolute == doctest::Approx(0.5));
  CHECK(difference.relative_mean_square == doctest::Approx(0.25 / 0.0725));
  CHECK(difference.peak_signal_to_noise_decibels == doctest::Approx(6.0206));
  CHECK(difference.differing_pixels == 4);
}

TEST_CASE("one channel of one pixel counts as one differing pixel") {
  Image picture = gray(10, 10, 1);
  picture.rgb[31] = 2;
  const Difference difference = measure_difference(picture, gray(10, 10, 1));
  CHECK(difference.differing_pixels == 1);
  CHECK(difference.largest == 1);
  CHECK(difference.mean_absolute == doctest::Approx(1.0 / 300));
}

TEST_CASE("values that are not finite make the errors infinite and never NaN") {
  const float infinity = std::numeric_limits<float>::infinity();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const float value : {infinity, -infinity, nan}) {
    const Difference difference = measure_difference(gray(1, 1, value), gray(1, 1, 0));
    CHECK(std::isinf(difference.root_mean_square));
    CHECK(std::isinf(difference.relative_mean_square));
    CHECK(measure_difference(gray(1, 1, value), gray(1, 1, value)).differing_pixels == 0);
  }
}

TEST_CASE("pictures of different sizes are refused") {
  CHECK_THROWS_WITH_AS(measure_difference(gray(4, 3, 0), gray(3, 4, 0)),
                       "the pictures differ in size, 4x3 and 3x4: only pictures of one size can be compared", core::InputError);
}

TEST_CASE("the difference picture holds the absolute differences") {
  const Image difference = difference_picture(gray(2, 1, 0.25F), gray(2, 1, 1));
  CHECK(difference.rgb == gray(2, 1, 0.75F).rgb);
}

TEST_CASE("the command compares files, prints the figures and writes the difference picture") {
  const tests::TemporaryFolder folder;
  write_image(folder / "a.exr", gray(3, 2, 0.5F));
  write_image(folder / "b.exr", gray(3, 2, 0.25F));
  std::ostringstream output;
  Interrupt interrupt;
  CHECK(compare_command({folder / "a.exr", folder / "b.exr", folder / "d.exr"}, interrupt, output) == 0);
  CHECK(output.str().find("root mean square error  0.25\n") != std::string::npos);
  CHECK(output.str().find("differing pixels        6 of 6 (100 %)\n") != std::string::npos);
  CHECK(read_image(folder / "d.exr").rgb == gray(3, 2, 0.25F).rgb);
}

TEST_CASE("no difference picture is written when the sizes differ") {
  const tests::TemporaryFolder folder;
  write_image(folder / "a.exr", gray(3, 2, 0));
  write_image(folder / "b.exr", gray(2, 3, 0));
  std::ostringstream output;
  Interrupt interrupt;
  CHECK_THROWS_AS(compare_command({folder / "a.exr", folder / "b.exr", folder / "d.exr"}, interrupt, output), core::InputError);
  CHECK_FALSE(std::filesystem::exists(folder / "d.exr"));
}

TEST_CASE("a difference picture that would replace one of the two is refused before anything is read") {
  const tests::TemporaryFolder folder;
  tests::write_text(folder / "a.exr", "no picture");
  std::ostringstream output;
  Interrupt interrupt;
  CHECK_THROWS_AS(compare_command({folder / "a.exr", folder / "b.exr", folder / "a.exr"}, interrupt, output), core::UsageError);
  CHECK_THROWS_AS(compare_command({folder / "a.exr", folder / "b.exr", folder / "b.exr"}, interrupt, output), core::UsageError);
  CHECK(tests::file_text(folder / "a.exr") == "no picture");
}

TEST_CASE("figures that cannot be printed are an error") {
  const tests::TemporaryFolder folder;
  write_image(folder / "a.exr", gray(1, 1, 0));
  std::ofstream full("/dev/full");
  Interrupt interrupt;
  CHECK_THROWS_AS(compare_command({folder / "a.exr", folder / "a.exr", {}}, interrupt, full), core::InputError);
}

}  // namespace dmpc::apps
