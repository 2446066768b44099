// Layers in files, as OpenImageIO reads them.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "apps/picture/film_image.h"
#include "apps/picture/layer_image.h"
#include "tests/apps/modules/read_file.h"

namespace dmpc::tests::layer_file_test {

namespace {

using apps::layer_file, apps::layer_image, apps::LayerImage;
using core::Layer;

constexpr int width = 5, height = 3;

core::Film film_of(const core::Color& light) {
  core::Film film(width, height);
  film.add_samples_to_all(2);
  for (std::uint32_t pixel = 0; pixel < film.pixel_count(); ++pixel) {
    film.deposit(pixel, {{core::to_fixed(light * static_cast<float>(2 * pixel)), {}}});
  }
  return film;
}

std::vector<float> floats_of(const ReadFile& file) { return file.values<float>(OIIO::TypeDesc::FLOAT); }

}  // namespace

TEST_CASE("a picture's file has its layers by name, each pixel's numbers with its light, and the light is as without them") {
  const core::Film light = film_of({1, 2, 4});
  const LayerImage albedo = layer_image(Layer::albedo, film_of({0.01F, 0.02F, 0.04F})),
                   normal = layer_image(Layer::normal, film_of({0.0625F, 0.03125F, 0})),
                   depth = layer_image(Layer::depth, film_of({8, 8, 8})), id = layer_image(Layer::id, film_of({1, 1, 1}));
  apps::ImageRows rows = apps::rows_of(light);
  const std::vector<float> plain = floats_of(ReadFile("a.exr", apps::encoded_picture("a.exr", rows)));
  rows.layers = {&albedo.channels, &normal.channels, &depth.channels, &id.channels};
  const ReadFile file("a.exr", apps::encoded_picture("a.exr", rows));
  const std::vector<std::string> names = file.spec().channelnames;
  for (const char* name :
       {"R", "G", "B", "albedo.R", "albedo.G", "albedo.B", "normal.X", "normal.Y", "normal.Z", "depth.Z", "id.X"}) {
    CAPTURE(name);
    CHECK(std::count(names.begin(), names.end(), name) == 1);
  }
  REQUIRE(names.size() == 11);
  CHECK(file.spec().format == OIIO::TypeDesc::FLOAT);
  const std::vector<float> values = floats_of(file);
  const auto value = [&](std::size_t pixel, const char* name) {
    return values[pixel * names.size() + static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin())];
  };
  for (std::size_t pixel = 0; pixel < width * height; ++pixel) {
    const auto number = static_cast<float>(pixel);
    CHECK(value(pixel, "R") == plain[3 * pixel]);
    CHECK(value(pixel, "B") == plain[3 * pixel + 2]);
    CHECK(value(pixel, "albedo.G") == doctest::Approx(0.02 * double{number}));
    CHECK(value(pixel, "normal.X") == number / 8 - 1);
    CHECK(value(pixel, "normal.Z") == -1);
    CHECK(value(pixel, "depth.Z") == 8 * number);
    CHECK(value(pixel, "id.X") == number);
  }
}

TEST_CASE("a layer's own file has plain names, and one to look at has colours") {
  const LayerImage normal = layer_image(Layer::normal, film_of({0.0625F, 0.03125F, 0}));
  CHECK(ReadFile("a.exr", layer_file("a.exr", normal)).spec().channelnames == std::vector<std::string>{"X", "Y", "Z"});
  const LayerImage depth = layer_image(Layer::depth, film_of({8, 8, 8})), id = layer_image(Layer::id, film_of({1, 1, 1}));
  CHECK(ReadFile("a.exr", layer_file("a.exr", depth)).spec().channelnames == std::vector<std::string>{"Z"});
  const auto bytes_of = [](const LayerImage& image) {
    return ReadFile("a.png", layer_file("a.png", image)).values<unsigned char>(OIIO::TypeDesc::UINT8);
  };
  const std::vector<unsigned char> shown = bytes_of(normal), near_and_far = bytes_of(depth), colors = bytes_of(id);
  CHECK(shown[3 * 8] == 128);  // pixel 8 has a normal of 0 along x
  CHECK((near_and_far[0] == 0 && near_and_far[3] > near_and_far[6] && near_and_far[3 * 14] > 0));
  CHECK((colors[0] == 0 && !std::equal(&colors[3], &colors[6], &colors[6])));
}

}  // namespace dmpc::tests::layer_file_test
