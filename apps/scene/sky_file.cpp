#include "apps/scene/sky_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <system_error>

#include "apps/frontend/line/number_text.h"
#include "apps/picture/picture_reader.h"
#include "core/base/expect.h"
#include "core/scene/sky_texels.h"

namespace dmpc::apps {
namespace {

/// The range of colours in --sky.
constexpr float light_max = 1e30F;

/// Negative values, which some programs produce next to bright areas, for example by sharpening, count as black.
bool is_light(float number) { return number >= -light_max && number <= light_max; }

std::string size_text(const Image& image) { return std::to_string(image.width) + "x" + std::to_string(image.height); }

std::string place_text(const Image& image, std::size_t number) {
  const std::size_t pixel = number / 3, width = static_cast<std::size_t>(image.width);
  return "pixel " + std::to_string(pixel % width) + "," + std::to_string(pixel / width);
}

void check_light(const Image& image) {
  const auto fault = std::find_if_not(image.rgb.begin(), image.rgb.end(), is_light);
  if (fault == image.rgb.end()) {
    return;
  }
  const auto place = static_cast<std::size_t>(fault - image.rgb.begin());
  const auto count = static_cast<std::uint64_t>(
      std::count_if(image.rgb.begin(), image.rgb.end(), [](float number) { return !is_light(number); }));
  constexpr std::array channels{"red", "green", "blue"};
  const std::string value = std::isnan(*fault) ? "not a number" : std::isinf(*fault) ? "infinite" : shortest(double{*fault});
  throw core::InputError(place_text(image, place) + " has " + channels[place % 3] + " that is " + value +
                         (count > 1 ? ", one of " + counted(count, "such number") : "") +
                         "; expected light from 0 to 1e30: write the picture again with such numbers replaced, black by 0");
}

void check_shape(const Image& image) {
  if (std::abs(image.width - 2 * image.height) > 1) {
    throw core::InputError(size_text(image) +
                           " pixels; expected a picture of all directions that is twice as wide as high, such as " +
                           std::to_string(2 * image.height) + "x" + std::to_string(image.height) +
                           ": longitude and latitude, as panoramas for skies have them");
  }
}

/// Sets negative values to 0; returns a note about them, or nothing.
std::string blacken(Image& image, const std::string& path) {
  const auto is_below = [](float number) { return number < 0; };
  const auto first = std::ranges::find_if(image.rgb, is_below);
  if (first == image.rgb.end()) {
    return "";
  }
  const std::string place = place_text(image, static_cast<std::size_t>(first - image.rgb.begin()));
  const auto count = static_cast<std::uint64_t>(std::ranges::count_if(image.rgb, is_below));
  std::ranges::replace_if(image.rgb, is_below, 0.0F);
  return path + ": numbers below 0, which count as 0 (the first in " + place + "): " + grouped(count);
}

std::optional<core::Vec3d> only_colour(const Image& image) {
  for (std::size_t i = 3; i < image.rgb.size(); ++i) {
    if (image.rgb[i] != image.rgb[i - 3]) {
      return std::nullopt;
    }
  }
  return core::Vec3d{double{image.rgb[0]}, double{image.rgb[1]}, double{image.rgb[2]}};
}

Image image_at(const std::string& path, Sandbox sandbox) {
  const Image image = PictureReader({.sandbox = sandbox}).read_sky(open_picture(path));
  check_shape(image);
  check_light(image);
  return image;
}

Image checked_image(const std::string& path, Sandbox sandbox) {
  try {
    return image_at(path, sandbox);
  } catch (const core::InputError& error) {
    const std::string text = error.what();
    std::error_code none;
    throw core::InputError("--sky=" + path + (text.starts_with(path + ": ") ? text.substr(path.size()) : ": " + text) +
                           (std::filesystem::exists(path, none) ? "" : "; expected a picture's file, or a colour such as 1,1,1"));
  }
}

}  // namespace

std::string read_sky(const std::string& path, Sandbox sandbox, core::Scene& scene) {
  Image image = checked_image(path, sandbox);
  std::string note = blacken(image, path);
  if (const auto colour = only_colour(image)) {
    scene.background = *colour;
    return note;
  }
  scene.background = {};
  scene.sky = core::sky_texels(static_cast<std::uint32_t>(image.width), static_cast<std::uint32_t>(image.height), image.rgb);
  scene.sky.name = path;
  return note;
}

std::string contrast_text(const core::SkyTexels& sky) {
  return sky.coarse == 0 ? ""
                         : sky.name + ": " + counted(sky.coarse, "texel") + " of " +
                               grouped(std::uint64_t{sky.width} * sky.height) + " are too faint beside the brightest, which is " +
                               rounded(sky.brightest) + ", to be shown exactly: steps of light there are a 2^40th of that";
}

}  // namespace dmpc::apps
