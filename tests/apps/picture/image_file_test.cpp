#include "apps/picture/image_file.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>

#include "core/base/expect.h"
#include "core/base/srgb.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::apps::image_file_test {

using tests::TemporaryFolder;

namespace {

/// Values from below 0 to far above 1.
Image gradient(int width, int height) {
  Image image(width, height);
  for (std::size_t index = 0; index < image.rgb.size(); ++index) {
    image.rgb[index] = static_cast<float>(index) * 0.37F - 0.5F;
  }
  return image;
}

}  // namespace

TEST_CASE("a float picture is read as it was written, unclamped") {
  const TemporaryFolder folder;
  const Image image = gradient(7, 5);
  for (const std::string name : {"a.exr", "a.tif", "a.TIFF"}) {
    CAPTURE(name);
    write_image(folder / name, image);
    const Image read = read_image(folder / name);
    CHECK(read.width == 7);
    CHECK(read.height == 5);
    CHECK(read.rgb == image.rgb);
  }
}

TEST_CASE("an 8-bit picture holds the clamped values on the sRGB curve") {
  const TemporaryFolder folder;
  const Image image = gradient(3, 4);
  for (const std::string name : {"a.png", "a.bmp", "a.tga"}) {
    CAPTURE(name);
    write_image(folder / name, image);
    const Image read = read_image(folder / name);
    REQUIRE(read.rgb.size() == image.rgb.size());
    for (std::size_t index = 0; index < read.rgb.size(); ++index) {
      CHECK(core::srgb_byte(read.rgb[index]) == core::srgb_byte(image.rgb[index]));
      CHECK(read.rgb[index] == doctest::Approx(core::linear_from_srgb(core::srgb_byte(image.rgb[index]) / 255.0)).epsilon(1e-6));
    }
  }
}

TEST_CASE("a picture whose pixels are asked for as they are wanted is the same file in every format") {
  const Image image = gradient(40, 70);
  const ImageRows rows{image.width, image.height,
                       [&image](std::size_t first, std::span<float> rgb) {
                         std::copy_n(image.rgb.begin() + static_cast<std::ptrdiff_t>(3 * first), rgb.size(), rgb.begin());
                       },
                       image.remarks};
  for (const std::string name : {"a.exr", "a.png", "a.tga"}) {
    CAPTURE(name);
    CHECK(encoded_picture(name, rows) == encoded_picture(name, image));
  }
}

TEST_CASE("an image without a float for every channel is a bug") {
  Image image(2, 2);
  image.rgb.pop_back();
  CHECK_THROWS_AS(encoded_picture("a.exr", image), core::InternalError);
  CHECK_THROWS_AS(encoded_picture("a.png", image), core::InternalError);
}

TEST_CASE("a JPEG is near to what was written") {
  const TemporaryFolder folder;
  Image image(16, 16);
  image.rgb.assign(image.rgb.size(), 0.25F);
  write_image(folder / "a.jpg", image);
  for (const float value : read_image(folder / "a.jpg").rgb) {
    CHECK(value == doctest::Approx(0.25).epsilon(0.03));
  }
}

TEST_CASE("a picture of one pixel is written and nothing else is left") {
  const TemporaryFolder folder;
  write_image(folder / "one.png", Image(1, 1));
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("an unknown or missing extension is refused with advice") {
  const TemporaryFolder folder;
  for (const std::string name : {"a.nonsense", "a", "a.null", "a.term"}) {
    CAPTURE(name);
    CHECK_THROWS_AS(check_image_path(folder / name, "-o"), core::InputError);
  }
  CHECK_THROWS_WITH_AS(check_image_path("a.nonsense", "-o"),
                       "a.nonsense: cannot write pictures of the kind .nonsense, use .exr or .tif (linear floats), .png or .jpg "
                       "(8 bits, sRGB)",
                       core::InputError);
  CHECK(folder.entry_count() == 0);
}

TEST_CASE("checking a picture's path leaves nothing behind and keeps an older picture") {
  const TemporaryFolder folder;
  check_image_path(folder / "a.png", "-o");
  CHECK(folder.entry_count() == 0);
  write_image(folder / "a.exr", gradient(2, 2));
  check_image_path(folder / "a.exr", "-o");
  CHECK(read_image(folder / "a.exr").rgb == gradient(2, 2).rgb);
}

TEST_CASE("a picture cannot go into a folder that is not there, and the option is named") {
  const TemporaryFolder folder;
  CHECK_THROWS_AS(write_image(folder / "nowhere/a.png", Image(1, 1)), core::InputError);
  CHECK_THROWS_WITH_AS(check_image_path(folder / "nowhere/a.png", "--difference"), doctest::Contains("--difference "),
                       core::InputError);
}

TEST_CASE("a picture cannot go into a pipe, and nothing is written there") {
  const TemporaryFolder folder;
  const std::string pipe = folder / "a.png";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  CHECK_THROWS_WITH_AS(check_image_path(pipe, "-o"), doctest::Contains("no ordinary file"), core::InputError);
  char byte = 0;
  CHECK(::read(reader, &byte, 1) == 0);
  ::close(reader);
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("what is no picture cannot be read") {
  const TemporaryFolder folder;
  tests::write_text(folder / "a.png", "not a picture");
  CHECK_THROWS_AS(read_image(folder / "a.png"), core::InputError);
  CHECK_THROWS_AS(read_image(folder / "missing.exr"), core::InputError);
  CHECK_THROWS_AS(read_image(folder.path()), core::InputError);
  tests::write_text(folder / "a.pfm", "PF -5 2\n-1 1 2 3");
  CHECK_THROWS_WITH_AS(read_image(folder / "a.pfm"), doctest::Contains("says that it has -5x2 pixels"), core::InputError);
}

}  // namespace dmpc::apps::image_file_test
