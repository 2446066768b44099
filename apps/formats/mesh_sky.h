// Skies that a scene's file says itself.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "apps/picture/image_file.h"
#include "core/base/vec.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// A square picture of all directions, in equal areas (P. Clarberg, "Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD",
/// JGT 2008), as pbrt-v4 has them.
struct MeshSky {
  std::string name;
  Image image;
  std::array<core::Vec3d, 3> rows;  ///< from a direction of the world to one of the picture
  core::Vec3d scale;                ///< what its light is multiplied by
};

/// Where in such a square, 0 to 1 to the right and downwards, a unit direction lies.
std::array<double, 2> equal_area_place(const core::Vec3d& direction);

/// Gives the scene one sky, below its zenith, that is as bright as all of them and its background together; a
/// picture's light that is below 0 or no number counts as none. The scene's background is black then. Throws core::InputError for
/// a picture that is not square.
void set_sky(const std::vector<MeshSky>& skies, core::Scene& scene);

}  // namespace dmpc::apps
