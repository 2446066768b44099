#include "apps/picture/exr_file.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "core/base/expect.h"
#include "core/base/sampling.h"
#include "tests/apps/modules/read_file.h"

namespace dmpc::tests::exr_file_test {

namespace {

using apps::exr_file;
using apps::ExrRows;

ReadFile read(const ExrRows& picture) { return ReadFile("a.exr", exr_file(picture)); }

std::vector<float> values_of(const ReadFile& file) { return file.values<float>(OIIO::TypeDesc::FLOAT); }

std::vector<float> noise(std::size_t count) {
  std::vector<float> values(count);
  for (std::size_t i = 0; i < count; ++i) {
    values[i] = static_cast<float>(core::mix(i)) * 0x1p-40F;
  }
  return values;
}

std::vector<float> slope(std::size_t count) {
  std::vector<float> values(count);
  for (std::size_t i = 0; i < count; ++i) {
    values[i] = static_cast<float>(i) * 0.25F - 3;
  }
  return values;
}

/// A picture from `values`, which outlive it: a pixel's numbers in the channels' order.
ExrRows picture_of(int width, int height, const std::vector<std::string>& channels, std::span<const float> values) {
  const auto take = [values, count = channels.size()](std::size_t first, std::span<float> some) {
    std::ranges::copy(values.subspan(first * count, some.size()), some.begin());
  };
  return {width, height, channels, take, {}};
}

ExrRows color_picture(int width, int height, std::span<const float> rgb) {
  return picture_of(width, height, {"R", "G", "B"}, rgb);
}

}  // namespace

TEST_CASE("OpenImageIO reads the floats that were written, whatever packs well, for every number of rows in the last block") {
  for (const int height : {1, 15, 16, 17, 33}) {
    for (const int width : {1, 2, 7, 64}) {
      CAPTURE(width);
      CAPTURE(height);
      const auto count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3;
      for (const std::vector<float>& rgb : {noise(count), slope(count), std::vector<float>(count, 0.5F)}) {
        const ReadFile file = read(color_picture(width, height, rgb));
        CHECK((file.spec().width == width && file.spec().height == height));
        CHECK(values_of(file) == rgb);
      }
    }
  }
}

TEST_CASE("infinities, zeros of both signs and what is no number come back") {
  const float infinity = std::numeric_limits<float>::infinity();
  const std::vector<float> rgb = {infinity, -infinity, -0.0F, std::numeric_limits<float>::quiet_NaN(), 0, 1e-40F};
  const std::vector<float> values = values_of(read(color_picture(2, 1, rgb)));
  CHECK((values[0] == infinity && values[1] == -infinity && std::signbit(values[2])));
  CHECK((std::isnan(values[3]) && values[4] == 0 && values[5] == 1e-40F));
}

TEST_CASE("a picture of colours has red, green and blue, as linear light, packed by zip") {
  const std::vector<float> rgb = slope(12);
  const ReadFile file = read(color_picture(2, 2, rgb));
  CHECK(file.spec().channelnames == std::vector<std::string>{"R", "G", "B"});
  CHECK(file.spec().get_string_attribute("compression") == "zip");
  CHECK(file.spec().get_string_attribute("Software") == "dmpc");
  CHECK(file.spec().get_string_attribute("oiio:ColorSpace") == "Linear");
}

TEST_CASE("a channel of numbers keeps its name and its remarks") {
  const std::vector<float> values = slope(6);
  ExrRows picture = picture_of(3, 2, {"references"}, values);
  picture.remarks = {{"dmpc:unit", "references"}, {"dmpc:nodes", "8"}};
  const ReadFile file = read(picture);
  CHECK(values_of(file) == values);
  CHECK(file.spec().channelnames == std::vector<std::string>{"references"});
  CHECK(file.spec().get_string_attribute("dmpc:unit") == "references");
  CHECK(file.spec().get_string_attribute("dmpc:nodes") == "8");
}

TEST_CASE("the same picture is the same file, and an even one a small file") {
  const std::vector<float> rgb(std::size_t{3} * 256 * 256, 0.25F);
  const std::string file = exr_file(color_picture(256, 256, rgb));
  CHECK(file == exr_file(color_picture(256, 256, rgb)));
  CHECK(file.size() < rgb.size() * sizeof(float) / 100);
}

TEST_CASE("a file has the same bytes whatever the number of threads that pack it") {
  for (const int height : {1, 16, 17, 333}) {
    CAPTURE(height);
    const auto count = static_cast<std::size_t>(height) * 40 * 3;
    for (const std::vector<float>& rgb : {noise(count), slope(count)}) {
      const std::string file = exr_file(color_picture(40, height, rgb), 1);
      CHECK(file == exr_file(color_picture(40, height, rgb), 2));
      CHECK(file == exr_file(color_picture(40, height, rgb), 5));
      CHECK(values_of(ReadFile("a.exr", file)) == rgb);
    }
  }
}

TEST_CASE("a name that is taken or that EXR has no room for is a bug") {
  const std::vector<float> values(5);
  CHECK_THROWS_AS(exr_file(picture_of(5, 1, {std::string(32, 'a')}, values)), core::InternalError);
  CHECK_THROWS_AS(exr_file(picture_of(5, 1, {"R", "R"}, values)), core::InternalError);
  ExrRows picture = picture_of(5, 1, {"R"}, values);
  picture.remarks = {{"channels", "of this name is what the file has of its own"}};
  CHECK_THROWS_AS(exr_file(picture), core::InternalError);
}

}  // namespace dmpc::tests::exr_file_test
