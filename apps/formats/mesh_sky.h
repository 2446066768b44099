// Skies from a scene's file.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "apps/picture/image_file.h"
#include "core/base/vec.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// A square equal-area picture of all directions (P. Clarberg, "Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD", JGT
/// 2008), as in pbrt-v4.
struct MeshSky {
  std::string name;
  Image image;
  std::array<core::Vec3d, 3> rows;  ///< rotates a direction of the world to one of the picture
  core::Vec3d scale;                ///< factor of its light
};

/// Position of a unit direction in such a square, 0 to 1 to the right and downwards.
std::array<double, 2> equal_area_place(const core::Vec3d& direction);

/// Gives the scene one sky, oriented by its zenith, as bright as all of them and its background together; texels that are
/// negative or NaN count as 0. The scene's background becomes black. Throws core::InputError for a picture that is not square.
void set_sky(const std::vector<MeshSky>& skies, core::Scene& scene);

}  // namespace dmpc::apps
