// Finds the hit of a ray in double precision: Embree offers the boxes along it, and the hit in each is computed in double.
#pragma once

#include <memory>

#include "apps/lab/oracle/reference/ray.h"
#include "apps/lab/oracle/reference/scene.h"

namespace dmpc::apps {

/// Embree gets boxes in float, relative to the scene's middle and size, each grown by `box_margin` times the distance of the
/// farthest ray's origin. This is more than float can move a ray, so no body is missed, whatever the scene's position and scale.
/// Immutable once made; every query is thread-safe.
class ReferenceFinder {
 public:
  /// `scene` outlives the finder; `eye` is where the farthest rays start. Builds with all cores. Throws InternalError if Embree
  /// reports an error.
  ReferenceFinder(const ReferenceScene& scene, const core::Vec3d& eye);
  ~ReferenceFinder();
  ReferenceFinder(const ReferenceFinder&) = delete;
  ReferenceFinder& operator=(const ReferenceFinder&) = delete;

  /// Returns the hit with the least (t, body) in (0, ray.t_max); the triangle ray.ignored_body is left out, and at the ray's
  /// start all that lies in its plane. Of triangles in one plane (share_plane()) that are hit there together, the first with the
  /// least core::Material::rank_in_plane() counts, as evaluated at each hit.
  ReferenceHit closest(const ReferenceRay& ray) const;
  /// Returns any hit, or none.
  ReferenceHit any(const ReferenceRay& ray) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace dmpc::apps
