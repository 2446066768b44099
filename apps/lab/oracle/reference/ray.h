// Rays and hits of the reference renderer: double precision, the scene's own coordinates.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "core/base/vec.h"
#include "core/record/ray.h"

namespace dmpc::apps {

/// A ray in world coordinates. Kinds and depths are those of core/record/ray.h.
struct ReferenceRay {
  core::Vec3d origin;
  core::Vec3d direction;                                   ///< unit vector
  double t_max = std::numeric_limits<double>::infinity();  ///< hits count in (0, t_max)
  std::uint32_t ignored_body = core::no_primitive;         ///< the body on which it starts; only its far side can be hit
  core::Vec3d weight{1, 1, 1};  ///< factor of the light it finds; for a shadow ray, the light that it brings if nothing blocks it
  int depth = 1;
  core::RayKind kind = core::RayKind::primary;
  std::uint32_t light = 0;  ///< shadow ray: index into the scene's lights
  /// The width of its footprint at its start; for a primary ray, the distance of its start from the eye.
  double cone = 0;
  /// Change of the directions of its pixel's primary rays per column and per row.
  std::array<core::Vec3d, 2> apart{};
  /// core::density_of() the bits of the density with which a surface scattered it; infinite for all others.
  double density = std::numeric_limits<double>::infinity();
  std::uint32_t pixel = 0, sample = 0;  ///< determine a path's random numbers
};

/// Returns the narrower of the two angles, in radians, under which a ray's pixel is seen from the eye.
double narrow_angle(const ReferenceRay& ray);

/// The least (t, body) that a ray meets; for a shadow ray any hit.
struct ReferenceHit {
  double t = std::numeric_limits<double>::infinity();
  std::uint32_t body = core::no_primitive;  ///< index into ReferenceScene::bodies

  bool found() const { return body != core::no_primitive; }
};

}  // namespace dmpc::apps
