// What float rounding does to rays and surfaces, done at random to the accurate renderer.
#pragma once

#include <cstdint>

#include "apps/oracle/accurate/scene.h"
#include "apps/oracle/accurate/tracer.h"

namespace dmpc::apps {

/// Moves what starts from one hit by as much as the product's arithmetic in float may. With u = 2^-24 and L the product's
/// grid-local unit:
///   a ray's start     u L, and what secondary rays start off their surface by (2^-21 L) in place of the accurate gap
///   its direction     4 u: its own rounding, that of the normal and of the index of refraction
///   a surface         u L against the ray, which moves the hit the farther the more they graze each other; then the distance is
///                     rounded, u (t + L), and point, normal and weights follow
///   a triangle        its corners are rounded by u L, which turns it by that over its height; a cone's ends likewise
///   a texture         the level of detail and the length of a line of probes by some 2^-16, in which the product counts shares
class Disturbance final : public RayWatcher {
 public:
  /// `unit`: L in world units.
  Disturbance(double unit, std::uint64_t seed) : unit_(unit), state_(seed) {}

  /// A primary ray, or one that starts from the surface last touched.
  void shoot(AccurateRay& ray) override;
  void touch(const AccurateRay& ray, const AccurateBody& body, AccurateSurface& surface) override;
  void look_up(AccurateFootprint& footprint) override;

 private:
  double random();  ///< uniform in -1 to 1
  core::Vec3d random_vector();

  double unit_;
  std::uint64_t state_;
  core::Vec3d normal_;  ///< of the surface last touched
};

}  // namespace dmpc::apps
