// Finds a ray beside another one that has the answer of a renderer: it proves that the answer is off by no more than a shift.
#pragma once

#include <cstdint>
#include <optional>

#include "apps/lab/oracle/referee.h"
#include "apps/lab/oracle/reference/finder.h"
#include "apps/lab/oracle/reference/ray.h"
#include "apps/lab/oracle/reference/scene.h"

namespace dmpc::apps {

struct ClaimedAnswer {
  bool hit = false;
  std::uint32_t body = core::no_primitive;  ///< a hit's body; an occluder may go unnamed
};

/// Searches for witnesses of a ray's answer in the scene as its file has it, without any knowledge of what the renderer makes of
/// the scene. Immutable, thread-safe.
class WitnessFinder {
 public:
  /// Both outlive it; `finder` is made of `scene`.
  WitnessFinder(const ReferenceScene& scene, const ReferenceFinder& finder) : scene_(scene), finder_(finder) {}

  /// Explains how `claimed`, which `ray` itself does not give, can come about.
  /// - silhouette: a ray at most `reach` beside it has that answer
  /// - end: a shadow ray that ends earlier or later by as much has it
  /// - tie: two surfaces are at most `reach` apart, and a ray at most `crossing` beside it has the answer
  ///
  /// Returns nothing if no such ray is found: then the answer is wrong, not just off. Lengths are in world units.
  std::optional<Verdict> find(const ReferenceRay& ray, const ClaimedAnswer& claimed, double reach, double crossing) const;
  /// Returns whether a ray at most `reach` beside it has the answer.
  bool is_beside(const ReferenceRay& ray, const ClaimedAnswer& claimed, double reach) const;
  /// Returns whether the ray meets the body of `hit` there, within `rounding` along it, or whether rays at most `reach` beside it
  /// do so before and behind that point.
  bool is_met(const ReferenceRay& ray, const ReferenceHit& hit, double rounding, double reach) const;

 private:
  /// Returns the ray moved sideways: its offset from the surface that it leaves, and its length, stay the same.
  ReferenceRay beside(const ReferenceRay& ray, const core::Vec3d& step) const;
  /// Returns whether accept(other) holds for a ray at most `reach` beside it; stops at the first.
  template <class Accept>
  bool any_beside(const ReferenceRay& ray, double reach, const Accept& accept) const;
  bool has(const ReferenceRay& ray, const ClaimedAnswer& claimed) const;
  bool is_at_end(const ReferenceRay& ray, const ClaimedAnswer& claimed, double reach) const;
  /// Returns whether the ray meets the two surfaces no farther apart than `reach`.
  bool is_level(const ReferenceRay& ray, const ClaimedAnswer& claimed, double reach) const;

  const ReferenceScene& scene_;
  const ReferenceFinder& finder_;
};

}  // namespace dmpc::apps
