// A ray beside another one that has the answer which a renderer gave: it shows that the answer is off by a shift and no more.
#pragma once

#include <cstdint>
#include <optional>

#include "apps/lab/oracle/referee.h"
#include "apps/lab/oracle/reference/finder.h"
#include "apps/lab/oracle/reference/ray.h"
#include "apps/lab/oracle/reference/scene.h"

namespace dmpc::apps {

/// What a renderer says of a ray.
struct ClaimedAnswer {
  bool hit = false;
  std::uint32_t body = core::no_primitive;  ///< a hit's body; an occluder may go unnamed
};

/// Asks rays about a ray, by the scene as its file has it: nothing of what the renderer makes of the scene is known here.
/// Immutable, thread-safe.
class WitnessFinder {
 public:
  /// Both outlive it; `finder` is made of `scene`.
  WitnessFinder(const ReferenceScene& scene, const ReferenceFinder& finder) : scene_(scene), finder_(finder) {}

  /// Explains how `claimed`, which `ray` itself does not give, can come about:
  ///   silhouette   a ray at most `reach` beside it has that answer
  ///   end          a shadow ray: one that ends earlier or later by as much has it
  ///   tie          two surfaces at most `reach` apart: a ray at most `crossing` beside it has it
  /// Returns nothing if no such ray is found: then the answer is wrong, not just off. Lengths are in world units.
  std::optional<Verdict> find(const ReferenceRay& ray, const ClaimedAnswer& claimed, double reach, double crossing) const;
  /// Whether a ray that runs `reach` aside of it at most has the answer.
  bool is_beside(const ReferenceRay& ray, const ClaimedAnswer& claimed, double reach) const;
  /// Whether the ray meets the body of `hit` there, within `rounding` along it; or rays that run `reach` aside of it at most do
  /// so before there and behind.
  bool is_met(const ReferenceRay& ray, const ReferenceHit& hit, double rounding, double reach) const;

 private:
  /// A ray moved across itself: it starts as far off the surface that it leaves, and is as long.
  ReferenceRay beside(const ReferenceRay& ray, const core::Vec3d& step) const;
  /// Whether accept(other) is true of a ray that runs `reach` aside at most; asks no further then.
  template <class Accept>
  bool any_beside(const ReferenceRay& ray, double reach, const Accept& accept) const;
  bool has(const ReferenceRay& ray, const ClaimedAnswer& claimed) const;
  bool is_at_end(const ReferenceRay& ray, const ClaimedAnswer& claimed, double reach) const;
  /// Whether the ray meets the two surfaces no farther apart than `reach`.
  bool is_level(const ReferenceRay& ray, const ClaimedAnswer& claimed, double reach) const;

  const ReferenceScene& scene_;
  const ReferenceFinder& finder_;
};

}  // namespace dmpc::apps
