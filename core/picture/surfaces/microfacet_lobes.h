// Shading of microfacet surfaces: glTF's metallic-roughness (Khronos, "glTF 2.0 Specification", appendix B).
//
// The surface is a mixture, by its metallic share, of a metal, whose reflectance at normal incidence is its base colour, and a
// dielectric: that reflects `reflectance` at normal incidence, and scatters what it does not reflect in its base colour, or
// transmits it. Scattered light has entered and leaves again as a smooth surface allows both (C. Kelemen, L. Szirmay-Kalos, "A
// Microfacet Based Coupled Specular-Matte BRDF Model with Importance Sampling", Eurographics 2001): a white and smooth surface is
// white under a white sky. The appendix uses what microfacets at the half vector do not reflect, with which such a surface
// reflects 1.5 times the light that it receives, seen at a cosine of 0.1.
#pragma once

#include <optional>

#include "core/base/vec.h"
#include "core/picture/hits/hit_state.h"
#include "core/picture/sampling/sample_pair.h"
#include "core/picture/surfaces/path_step.h"
#include "core/scene/scene.h"

namespace dmpc::core {

/// For a hit that has_microfacets() and whose surface is known. The uncovered share (alpha) transmits rays, as glass does. Light
/// comes and goes above both the blended normal and the true one; other light is lost. An eye below the blended normal is treated
/// as one that is as far above it.
class MicrofacetLobes {
 public:
  explicit MicrofacetLobes(const HitState& state);

  /// The arguments of scatters() and response_towards().
  bool scatters() const { return chances_.scattered > 0.0 || (!is_mirror() && chances_.reflected > 0.0); }
  Vec3d response(const Vec3d& in) const;
  double density(const Vec3d& in) const;
  /// A continuation of the path, by scattering, microfacets or transmission, weighted for all techniques that could have chosen
  /// it; nothing if it leads nowhere.
  std::optional<PathStep> step(const SamplePair& choice, const SamplePair& direction) const;

 private:
  struct Chances {
    double scattered = 0, reflected = 0, through = 0;
    double all() const { return scattered + reflected + through; }
  };

  bool is_mirror() const;
  double share_at(double cosine) const;
  /// The density of the matt layer's directions relative to a surface without refraction, where there are any.
  double crowding_at(double cosine) const;
  Vec3d matt_direction(const SamplePair& direction) const;
  Vec3d reflected_share(double cosine) const;
  std::optional<PathStep> spread_step(const Vec3d& in) const;
  PathStep mirror_step() const;
  PathStep through_step() const;
  Vec3d reflected_direction(const SamplePair& direction) const;

  const HitState& state_;
  HitState::Microfacets facets_;
  Vec3d out_;           ///< towards the ray's origin, or mirrored to above the normal
  double cosine_;       ///< between out_ and the normal
  double index_;        ///< relative_index()
  Vec3d straight_;      ///< reflectance at normal incidence
  Vec3d scattered_;     ///< colour of light that is not reflected
  double unreflected_;  ///< the share of light towards `out_` that is not reflected, times the reflectance at normal incidence
  Chances chances_;
};

struct MicrofacetBound {
  double direct = 0;     ///< maximum of any channel, pi times MicrofacetLobes::response(): for a point light
  double passed_on = 0;  ///< maximum of any channel of the weight of MicrofacetLobes::step()
};

/// Bounds for a microfacet material whose colour is multiplied by at most `texture_max`. `facets`: its texture of metal and
/// roughness, if it has one.
MicrofacetBound bound_of(const Material& material, double texture_max = 1, const Texture* facets = nullptr);

/// The share of light that it reflects or transmits at normal incidence, in the brightest channel, if microfacets lose none:
/// above 1 the surface would create light.
double sent_on_straight(const Material& material);

}  // namespace dmpc::core
