// Disturbs rays and surfaces of the reference renderer at random, as float rounding does.
#pragma once

#include <cstdint>

#include "apps/lab/oracle/reference/scene.h"
#include "apps/lab/oracle/reference/tracer.h"

namespace dmpc::apps {

/// Relative error of rounding to single precision.
inline constexpr double float_rounding = 0x1p-24;

/// Moves all that starts from one hit by as much as the product's arithmetic in float may. Here u = 2^-24, and L is the product's
/// grid-local unit.
/// - a ray's start: 2^-45 L; secondary rays, by their offset from the surface, 2^-20 (L + the body's radii) + 2^-23 t, along
///   their way and, off a triangle that they graze, across it
/// - its direction: 2^-45; behind glass or off an interpolated normal 4 u, as indices of refraction and such normals are rounded
/// - a light: u L, and with it the cosine at which its light falls on the surface
/// - a surface: u L against the ray, or 2^-32 L if it is curved, which moves the hit the farther the more the ray grazes it; the
///   radius is rounded likewise, with the same effect along the ray, and point, normal and weights follow
/// - a triangle: its corners are rounded by u L, which turns it by that over its height, and changes a point's weights of the
///   corners, and so their colours and alpha, by as much; a cone's ends by 2^-32 L
/// - a texture: the level of detail and the length of a line of probes by some 2^-16, the unit in which the product counts shares
class Disturbance final : public RayWatcher {
 public:
  /// `unit` is L in world units.
  Disturbance(double unit, std::uint64_t seed) : unit_(unit), state_(seed) {}

  /// Disturbs a primary ray, or one that starts from the surface last touched.
  void shoot(ReferenceRay& ray) override;
  void touch(const ReferenceRay& ray, const ReferenceBody& body, ReferenceSurface& surface) override;
  void look_up(ReferenceFootprint& footprint) override;

 private:
  double random();  ///< uniform in -1 to 1
  core::Vec3d random_vector();

  double unit_;
  std::uint64_t state_;
  // These belong to the surface last touched.
  core::Vec3d normal_;
  double t_ = 0, size_ = 0;
  bool is_flat_ = false, is_smooth_ = false;
};

}  // namespace dmpc::apps
