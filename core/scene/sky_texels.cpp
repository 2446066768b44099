#include "core/scene/sky_texels.h"

#include <algorithm>
#include <cmath>

#include "core/base/expect.h"
#include "core/scene/texel.h"

namespace dmpc::core {
namespace {

/// The brightest texel lies below 2 to this power; the next power exceeds a texel's range.
constexpr int brightest_exponent = 15;

}  // namespace

SkyTexels sky_texels(std::uint32_t width, std::uint32_t height, std::span<const float> rgb) {
  expect(width > 0 && height > 0 && width <= SkyTexels::size_max && height <= SkyTexels::size_max &&
             rgb.size() == std::size_t{width} * height * 3,
         "a sky's picture has three numbers for each of its texels");
  int exponent = 0;
  std::frexp(double{*std::max_element(rgb.begin(), rgb.end())}, &exponent);
  SkyTexels sky{
      .name = {}, .width = width, .height = height, .texels = {}, .scale = std::ldexp(1.0, exponent - brightest_exponent)};
  sky.texels.reserve(std::size_t{width} * height);
  for (std::size_t i = 0; i < rgb.size(); i += 3) {
    const Vec3d light = Vec3d{double{rgb[i]}, double{rgb[i + 1]}, double{rgb[i + 2]}} * (1 / sky.scale);
    sky.texels.push_back(encoded(TexelFormat::shared_exponent, light));
    const Color kept = decoded(TexelFormat::shared_exponent, sky.texels.back());
    sky.brightest = std::max(sky.brightest, double{std::max({kept.x, kept.y, kept.z})} * sky.scale);
    const Vec3d off = Vec3d(kept) - light;
    const double most_off = std::max({std::fabs(off.x), std::fabs(off.y), std::fabs(off.z)});
    sky.coarse += most_off > largest_component(light) * 0x1p-7 ? 1 : 0;
  }
  return sky;
}

Vec3d sky_middle(const Vec3d& up) {
  std::size_t nearest = 0;
  for (std::size_t axis = 1; axis < 3; ++axis) {
    nearest = std::fabs(up[axis]) > std::fabs(up[nearest]) ? axis : nearest;
  }
  Vec3d ahead;
  ahead[(nearest + 1) % 3] = 1;
  return normalize(ahead - up * dot(ahead, up));
}

}  // namespace dmpc::core
