// What a hit on a surface of microfacets does with light: glTF's metallic-roughness (Khronos, "glTF 2.0 Specification",
// appendix B).
//
// It is a metal, which reflects its base colour straight ahead, by its metallic share, and for the rest something that does not
// conduct: that reflects `reflectance` straight ahead, and what it does not reflect it scatters in its base colour, or lets
// through. What is scattered has come in and gets out again as a smooth surface allows both (C. Kelemen, L. Szirmay-Kalos, "A
// Microfacet Based Coupled Specular-Matte BRDF Model with Importance Sampling", Eurographics 2001): white and smooth it is white
// under a white sky. The appendix takes what mirrors half-way between both directions do not reflect, by which such a surface
// sends on 1.5 times the light that it gets, seen at a cosine of 0.1.
#pragma once

#include <optional>

#include "core/base/vec.h"
#include "core/picture/hits/hit_state.h"
#include "core/picture/sampling/sample_pair.h"
#include "core/picture/surfaces/path_step.h"
#include "core/scene/scene.h"

namespace dmpc::core {

/// Of a hit that has_microfacets() and of which all is known. What alpha leaves out lets rays through, as glass does. Light comes
/// and goes above the blended normal and the true one; what would go elsewhere is lost. An eye below the blended normal counts as
/// one that is as far above it.
class MicrofacetLobes {
 public:
  explicit MicrofacetLobes(const HitState& state);

  /// What scatters() and response_towards() tell, of `in`.
  bool scatters() const { return chances_.scattered > 0.0 || (!is_mirror() && chances_.reflected > 0.0); }
  Vec3d response(const Vec3d& in) const;
  double density(const Vec3d& in) const;
  /// A way on, by one of what scatters, the tiny mirrors and what lets through, which counts for all ways to get there; nothing
  /// if it leads nowhere.
  std::optional<PathStep> step(const SamplePair& choice, const SamplePair& direction) const;

 private:
  struct Chances {
    double scattered = 0, reflected = 0, through = 0;
    double all() const { return scattered + reflected + through; }
  };

  bool is_mirror() const;
  double share_at(double cosine) const;
  /// How many times as dense the matt layer's directions are as above a surface that bends nothing, where there are any.
  double crowding_at(double cosine) const;
  Vec3d matt_direction(const SamplePair& direction) const;
  Vec3d reflected_share(double cosine) const;
  std::optional<PathStep> spread_step(const Vec3d& in) const;
  PathStep mirror_step() const;
  PathStep through_step() const;
  Vec3d reflected_direction(const SamplePair& direction) const;

  const HitState& state_;
  HitState::Microfacets facets_;
  Vec3d out_;           ///< whence the ray comes, or above the normal beside that
  double cosine_;       ///< of `out_`
  double index_;        ///< relative_index()
  Vec3d straight_;      ///< reflected straight ahead
  Vec3d scattered_;     ///< of light that is not reflected
  double unreflected_;  ///< the share, of light towards `out_`, that is not reflected but would be straight ahead
  Chances chances_;
};

struct MicrofacetBound {
  double direct = 0;     ///< in any channel, pi times MicrofacetLobes::response(): of a point light's
  double passed_on = 0;  ///< in any channel, the weight of MicrofacetLobes::step()
};

/// Of a material that has microfacets, whose colour is multiplied by no more than `texture_max`. `facets`: its texture of metal
/// and roughness, if it has one.
MicrofacetBound bound_of(const Material& material, double texture_max = 1, const Texture* facets = nullptr);

/// The share of light that it sends on straight ahead, in the brightest channel, if the tiny mirrors lose none: more than 1 gives
/// more light than comes.
double sent_on_straight(const Material& material);

}  // namespace dmpc::core
