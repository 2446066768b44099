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
  double scale = 1;                     ///< a power of two: what they are multiplied by
  double brightest = 0;                 ///< of all channels of all texels
  std::uint64_t coarse = 0;             ///< texels that are off by more than 1/128 of their largest channel

  bool is_there() const { return width > 0; }
};

/// Of three numbers for each texel, each 0 or more and finite, one of them above 0; neither side longer than size_max. The
/// brightest comes near the largest that a texel holds; an error is up to 1/512 of a texel's largest channel, or 2^-40 of the
/// brightest, which beside a very bright one makes others coarse.
SkyTexels sky_texels(std::uint32_t width, std::uint32_t height, std::span<const float> rgb);

/// In a world whose zenith is the unit vector `up`: where the middle of a sky's picture lies, of unit length and at a right angle
/// to that. Where up is y, along z (as OpenEXR has it: "Reading and Writing OpenEXR Image Files", environment maps); where it is
/// z, along x (as Blender has it); where x, along y. Elsewhere as for the axis that is nearest.
Vec3d sky_middle(const Vec3d& up);

}  // namespace dmpc::core
