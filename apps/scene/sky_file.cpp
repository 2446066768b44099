#include "apps/scene/sky_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <system_error>

#include "apps/edge/line/number_text.h"
#include "apps/picture/picture_reader.h"
#include "core/base/expect.h"
#include "core/scene/sky_texels.h"

namespace dmpc::apps {
namespace {

/// As --sky takes numbers of colours.
constexpr float light_max = 1e30F;

bool is_light(float number) { return number >= 0 && number <= light_max; }

std::string size_text(const Image& image) { return std::to_string(image.width) + "x" + std::to_string(image.height); }

void check_light(const Image& image) {
  const auto fault = std::find_if_not(image.rgb.begin(), image.rgb.end(), is_light);
  if (fault == image.rgb.end()) {
    return;
  }
  const auto place = static_cast<std::size_t>(fault - image.rgb.begin()), pixel = place / 3,
             width = static_cast<std::size_t>(image.width);
  const auto count = static_cast<std::uint64_t>(
      std::count_if(image.rgb.begin(), image.rgb.end(), [](float number) { return !is_light(number); }));
  constexpr std::array channels{"red", "green", "blue"};
  const std::string value = std::isnan(*fault) ? "not a number" : std::isinf(*fault) ? "infinite" : shortest(double{*fault});
  throw core::InputError("pixel " + std::to_string(pixel % width) + "," + std::to_string(pixel / width) + " has " +
                         channels[place % 3] + " that is " + value +
                         (count > 1 ? ", one of " + counted(count, "such number") : "") +
                         "; expected light from 0 to 1e30: write the picture anew with such numbers replaced, black by 0");
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
  const Image image = checked_image(path, sandbox);
  if (const auto colour = only_colour(image)) {
    scene.background = *colour;
    return "";
  }
  scene.background = {};
  scene.sky = core::sky_texels(static_cast<std::uint32_t>(image.width), static_cast<std::uint32_t>(image.height), image.rgb);
  scene.sky.name = path;
  return image.width == 2 * image.height
             ? ""
             : path + ": " + size_text(image) +
                   " pixels are taken for all directions, which a picture shows that is twice as wide as high: it is stretched";
}

}  // namespace dmpc::apps
