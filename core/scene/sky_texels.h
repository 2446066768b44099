// A sky's picture on the host, before it is cut into tiles.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/base/vec.h"

namespace dmpc::core {

/// All directions, in equirectangular projection: rows from the zenith down, each once round to the right.
struct SkyTexels {
  static constexpr std::uint32_t size_max = 65535;  ///< along a side

  std::string name;                     ///< the file's, for messages
  std::uint32_t width = 0, height = 0;  ///< 0: there is no picture
  std::vector<std::uint32_t> texels;    ///< with TexelFormat::shared_exponent, of `scale`
  double scale = 1;                     ///< factor of the texels, a power of two
  double brightest = 0;                 ///< maximum over all channels of all texels
  std::uint64_t coarse = 0;             ///< texels that are off by more than 1/128 of their largest channel

  bool is_there() const { return width > 0; }
};

/// From three numbers for each texel, each 0 or more and finite, one of them above 0; neither side longer than size_max. The
/// brightest comes near the largest value of a texel; the error is up to 1/512 of a texel's largest channel, or 2^-40 of the
/// brightest, so that a very bright one makes others coarse.
SkyTexels sky_texels(std::uint32_t width, std::uint32_t height, std::span<const float> rgb);

/// The direction of the middle of a sky's picture, in a world whose zenith is the unit vector `up`; of unit length and
/// perpendicular to it. If up is y, it is z (as in OpenEXR: "Reading and Writing OpenEXR Image Files", environment maps); if z, x
/// (as in Blender); if x, y. Otherwise as for the nearest axis.
Vec3d sky_middle(const Vec3d& up);

}  // namespace dmpc::core
