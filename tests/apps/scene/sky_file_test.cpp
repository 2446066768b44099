// A sky's picture as a file has it: what is read, and what is refused with what to do.
#include "apps/scene/sky_file.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "apps/picture/image_file.h"
#include "apps/picture/picture_reader.h"
#include "core/base/expect.h"
#include "tests/support/complaint.h"
#include "tests/support/sky_pictures.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::apps::sky_file_test {

using tests::contains;

namespace {

/// What reading a sky from `path` says.
std::string sky_complaint(const std::string& path) {
  core::Scene scene;
  return tests::complaint_of([&] { read_sky(path, Sandbox::available, scene); });
}

/// As a file of the format that the name ends in.
struct File {
  File(const std::string& name, int width, int height, std::vector<float> rgb) : path((folder.path() / name).string()) {
    Image image(width, height);
    image.rgb = std::move(rgb);
    write_image(path, image);
  }

  std::string complaint() const { return sky_complaint(path); }

  tests::TemporaryFolder folder;
  std::string path;
};

std::vector<float> with(float number, std::size_t place) {
  std::vector<float> rgb(8 * 4 * 3, 0.5F);
  rgb[place] = number;
  return rgb;
}

}  // namespace

TEST_CASE("a picture of floats is light as it is, one of bytes has the sRGB curve") {
  const std::vector<float> rgb = tests::sunny_sky(16, 3);
  core::Scene from_floats, from_bytes;
  CHECK(read_sky(File("sky.exr", 16, 8, rgb).path, Sandbox::available, from_floats).empty());
  CHECK(from_floats.sky.width == 16);
  CHECK(from_floats.sky.height == 8);
  CHECK(from_floats.sky.texels == core::sky_texels(16, 8, rgb).texels);
  CHECK(read_sky(File("sky.png", 16, 8, rgb).path, Sandbox::available, from_bytes).empty());
  CHECK(from_bytes.sky.brightest == doctest::Approx(1).epsilon(0.01));
}

TEST_CASE("a picture whose texels are all alike is a background of that colour, and no picture") {
  core::Scene scene;
  CHECK(read_sky(File("grey.exr", 4, 2, std::vector<float>(24, 0.25F)).path, Sandbox::available, scene).empty());
  CHECK_FALSE(scene.sky.is_there());
  CHECK(scene.background == core::Vec3d{0.25, 0.25, 0.25});
  CHECK(read_sky(File("one.exr", 1, 1, {1, 2, 3}).path, Sandbox::available, scene).empty());
  CHECK(scene.background == core::Vec3d{1, 2, 3});
}

TEST_CASE("a picture that is not twice as wide as high, but for a pixel, is refused with what was expected") {
  const auto of_size = [](int width, int height) {
    std::vector<float> rgb(static_cast<std::size_t>(width * height) * 3, 0.5F);
    rgb[0] = 1;
    return File("a.exr", width, height, rgb).complaint();
  };
  CHECK(contains(of_size(4, 4),
                 "a.exr: 4x4 pixels; expected a picture of all directions that is twice as wide as high, such as 8x4"));
  CHECK(contains(of_size(6, 4), "6x4 pixels"));
  CHECK(of_size(7, 4).empty());
  CHECK(of_size(9, 4).empty());
}

TEST_CASE("what is below 0 in a sky is black, and said with its place") {
  core::Scene scene;
  std::vector<float> rgb = with(-0.25F, (2 * 8 + 3) * 3 + 1);
  rgb[90] = -1;
  CHECK(contains(read_sky(File("a.exr", 8, 4, rgb).path, Sandbox::available, scene),
                 "a.exr: numbers below 0, which count as 0 (the first in pixel 3,2): 2"));
  rgb[90] = rgb[(2 * 8 + 3) * 3 + 1] = 0;
  CHECK(scene.sky.texels == core::sky_texels(8, 4, rgb).texels);
}

TEST_CASE("a sky of too much contrast for its texels is said to be") {
  core::Scene scene;
  read_sky(File("a.exr", 8, 4, with(1e9F, 0)).path, Sandbox::available, scene);
  CHECK(contrast_text(scene.sky).empty());
  read_sky(File("a.exr", 8, 4, with(1e12F, 0)).path, Sandbox::available, scene);
  CHECK(contains(contrast_text(scene.sky), "a.exr: 31 texels of 32 are too faint beside the brightest, which is "));
}

TEST_CASE("numbers that are no light are told with file, pixel, channel and value, and what to do") {
  CHECK(contains(File("a.exr", 8, 4, with(2e30F, 0)).complaint(), "a.exr: pixel 0,0 has red that is 2.0000"));
  CHECK(contains(File("a.exr", 8, 4, with(std::nanf(""), (2 * 8 + 3) * 3 + 1)).complaint(),
                 "pixel 3,2 has green that is not a number"));
  CHECK(contains(File("a.exr", 8, 4, with(std::numeric_limits<float>::infinity(), 31 * 3 + 2)).complaint(),
                 "pixel 7,3 has blue that is infinite"));
  std::vector<float> two = with(2e30F, 5);
  two[7] = std::nanf("");
  const std::string complaint = File("a.exr", 8, 4, two).complaint();
  CHECK(contains(complaint, "--sky="));
  CHECK(contains(complaint, "one of 2 such numbers"));
  CHECK(contains(complaint, "write the picture again"));
}

TEST_CASE("what is no file, or no picture, is an error that names the option") {
  CHECK(contains(sky_complaint("/nowhere/a.hdr"), "--sky=/nowhere/a.hdr: "));
  CHECK(contains(sky_complaint("/nowhere/a.hdr"), "expected a picture's file, or a colour such as 1,1,1"));
  CHECK(contains(sky_complaint("/"), "--sky=/: "));
}

TEST_CASE("a sky that is too large for a scene, or for this computer, is refused before there is room for it") {
  const File file("a.png", 64, 32, std::vector<float>(64 * 32 * 3, 0.5F));
  PictureReader reader({.texture_bytes_max = 1000});
  CHECK_THROWS_WITH_AS(reader.read_sky(open_picture(file.path)), doctest::Contains("a sky of 64x32 texels takes"),
                       core::CapacityError);
}

}  // namespace dmpc::apps::sky_file_test
