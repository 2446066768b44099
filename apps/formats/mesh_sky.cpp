#include "apps/formats/mesh_sky.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "core/base/elementary.h"
#include "core/base/expect.h"
#include "core/scene/sky_texels.h"

namespace dmpc::apps {
namespace {

using core::Vec3d;

constexpr double light_max = 1e30;
/// So often is each texel's sky looked at along both its sides.
constexpr int looks = 2;

Vec3d pixel_of(const Image& image, int column, int row) {
  const auto x = static_cast<std::size_t>(std::clamp(column, 0, image.width - 1)),
             y = static_cast<std::size_t>(std::clamp(row, 0, image.height - 1));
  const std::size_t first = (y * static_cast<std::size_t>(image.width) + x) * 3;
  const auto channel = [&](std::size_t i) {
    const double light = double{image.rgb[first + i]};
    return light > 0 ? std::min(light, light_max) : 0;
  };
  return {channel(0), channel(1), channel(2)};
}

/// Between the middles of pixels bilinearly.
Vec3d light_from(const MeshSky& sky, const Vec3d& world) {
  const Vec3d own = normalize(Vec3d{dot(sky.rows[0], world), dot(sky.rows[1], world), dot(sky.rows[2], world)});
  const auto [s, t] = equal_area_place(own);
  const double x = s * sky.image.width - 0.5, y = t * sky.image.height - 0.5;
  const int left = static_cast<int>(std::floor(x)), top = static_cast<int>(std::floor(y));
  const double across = x - left, down = y - top;
  const auto row = [&](int at) {
    return pixel_of(sky.image, left, at) * (1 - across) + pixel_of(sky.image, left + 1, at) * across;
  };
  return (row(top) * (1 - down) + row(top + 1) * down) * sky.scale;
}

/// Directions of a picture as in core/scene/sky_texels.h: its middle lies along `middle`, its left half to the left.
struct Directions {
  Vec3d up, middle, right;

  Vec3d at(double s, double t) const {
    const double around = (s - 0.5) * 2 * std::numbers::pi, polar = t * std::numbers::pi;
    const double across = core::sin_radians(polar);
    return up * core::cos_radians(polar) + (middle * core::cos_radians(around) + right * core::sin_radians(around)) * across;
  }
};

Vec3d texel_of(const std::vector<MeshSky>& skies, const Directions& directions, double x, double y, double width, double height) {
  Vec3d sum;
  for (int row = 0; row < looks; ++row) {
    for (int column = 0; column < looks; ++column) {
      const Vec3d world = directions.at((x + (column + 0.5) / looks) / width, (y + (row + 0.5) / looks) / height);
      for (const MeshSky& sky : skies) {
        sum = sum + light_from(sky, world);
      }
    }
  }
  return sum * (1.0 / (looks * looks));
}

}  // namespace

std::array<double, 2> equal_area_place(const Vec3d& direction) {
  const Vec3d d{std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)};
  const double from_pole = std::sqrt(std::max(1 - d.z, 0.0)), around = core::angle_of(d.y, d.x) * (2 / std::numbers::pi);
  double down = around * from_pole, across = from_pole - down;
  if (direction.z < 0) {  // the lower half is folded outwards
    const double folded = 1 - down;
    down = 1 - across;
    across = folded;
  }
  return {(std::copysign(across, direction.x) + 1) / 2, (std::copysign(down, direction.y) + 1) / 2};
}

void set_sky(const std::vector<MeshSky>& skies, core::Scene& scene) {
  if (skies.empty()) {
    return;
  }
  int side = 1;
  for (const MeshSky& sky : skies) {
    if (sky.image.width != sky.image.height) {
      throw core::InputError(sky.name + ": a sky of " + std::to_string(sky.image.width) + "x" + std::to_string(sky.image.height) +
                             " pixels; pbrt-v4 has square ones, of equal areas, which its imgtool makeequiarea makes");
    }
    side = std::max(side, sky.image.height);
  }
  const auto height = static_cast<std::uint32_t>(std::min<int>(side, core::SkyTexels::size_max / 2)), width = 2 * height;
  Directions directions{.up = zenith_of(scene), .middle = {}, .right = {}};
  directions.middle = core::sky_middle(directions.up);
  directions.right = cross(directions.middle, directions.up);
  std::vector<float> rgb;
  rgb.reserve(std::size_t{width} * height * 3);
  for (std::uint32_t y = 0; y < height; ++y) {
    for (std::uint32_t x = 0; x < width; ++x) {
      const Vec3d light = texel_of(skies, directions, x, y, width, height) + scene.background;
      for (const double channel : {light.x, light.y, light.z}) {
        rgb.push_back(static_cast<float>(std::min(channel, light_max)));
      }
    }
  }
  if (*std::max_element(rgb.begin(), rgb.end()) > 0) {
    scene.sky = core::sky_texels(width, height, rgb);
    scene.sky.name = skies.front().name;
    scene.background = {};
  }
}

}  // namespace dmpc::apps
