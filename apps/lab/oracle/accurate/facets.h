// Surfaces of tiny mirrors in double precision, written anew from the definition: what core's are measured against.
#pragma once

#include <optional>

#include "core/base/vec.h"
#include "core/picture/sample_pair.h"
#include "core/record/ray.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// What is known of a hit on one. The normals lie on the ray's side.
struct FacetedPlace {
  core::Microfacets facets;
  core::Vec3d base;       ///< the colour there
  double there = 1;       ///< the share of the surface that is, its opacity included
  double index = 1;       ///< of refraction: on the ray's side over the other one
  core::Vec3d direction;  ///< of the ray
  core::Vec3d normal;     ///< for shading
  core::Vec3d true_normal;
};

/// A way on.
struct FacetedStep {
  core::Vec3d towards, weight;
  core::RayKind kind{};
};

/// GGX, height-correlated Smith, Schlick's Fresnel, over a Lambertian that is coupled to a smooth surface. Directions come from
/// the product's chances by the product's maps.
class AccurateFacets {
 public:
  explicit AccurateFacets(const FacetedPlace& place);

  /// The BRDF times pi and the cosine of `in`; 0 below either normal.
  core::Vec3d response(const core::Vec3d& in) const;
  /// Of step(), per steradian, of all ways that scatter; 0 below either normal.
  double density(const core::Vec3d& in) const;
  std::optional<FacetedStep> step(const core::SamplePair& choice, const core::SamplePair& direction) const;

 private:
  double fresnel(double cosine) const;
  core::Vec3d tinted(double cosine) const;
  core::Vec3d matt(double cosine) const;
  bool is_above(const core::Vec3d& in) const;
  bool transmits() const;
  double alpha() const { return place_.facets.roughness * place_.facets.roughness; }
  double smith(double cosine) const;
  double normals_at(double cosine) const;
  std::optional<FacetedStep> spread(const core::Vec3d& in) const;

  FacetedPlace place_;
  core::Vec3d out_;
  double cosine_ = 0;
  double scattered_ = 0, reflected_ = 0, through_ = 0, all_ = 0;  ///< how likely each way is, times all
};

}  // namespace dmpc::apps
