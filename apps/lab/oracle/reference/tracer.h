// Computes the light that a ray brings, in double precision throughout: NFF's surfaces as Haines defines them, written anew from
// the definition. Core's shading is measured against it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "apps/lab/oracle/reference/finder.h"
#include "apps/lab/oracle/reference/scene.h"
#include "core/picture/sampling/sample_pair.h"
#include "core/picture/shade.h"
#include "core/picture/surfaces/path_step.h"

namespace dmpc::apps {

/// Observes, and may disturb, every ray of a tracer. Rays come in the order of the product: depth first, a hit's shadow rays in
/// the order of the lights, then its reflected ray with all that follows from it, then the refracted one.
class RayWatcher {
 public:
  virtual ~RayWatcher() = default;

  virtual void shoot(ReferenceRay&) {}
  /// A ray other than a shadow ray met `body` here.
  virtual void touch(const ReferenceRay&, const ReferenceBody&, ReferenceSurface&) {}
  /// A texture is about to be looked up with this footprint.
  virtual void look_up(ReferenceFootprint&) {}
  virtual void end(const ReferenceRay&, const ReferenceHit&) {}
};

/// Not thread-safe: each thread needs its own.
class ReferenceTracer {
 public:
  /// All outlive the tracer; `watcher` may be null. Secondary rays start 1e-13 of their body's coordinates and radius off it.
  /// Texture look-ups match those of the product's first samples, with the pixel coverage of the ray's own camera; they are point
  /// look-ups if the options give the rays no share of it. Paths use the product's random numbers if its grid has the world's
  /// axes.
  ReferenceTracer(const ReferenceScene& scene, const ReferenceFinder& finder, const core::ShadeOptions& options,
                  RayWatcher* watcher = nullptr)
      : scene_(scene), finder_(finder), options_(options), watcher_(watcher) {}

  /// Returns the linear radiance of a ray with all rays that follow from it.
  core::Vec3d radiance(ReferenceRay ray);
  /// Returns the light that a hit by itself sends back along `ray`, which is no shadow ray: its emission, and the ambient light
  /// that its diffuse part reflects.
  core::Vec3d glow(const ReferenceRay& ray, const ReferenceHit& hit) const;
  /// Returns the rays that start where `ray`, which is no shadow ray, meets `hit`, in the order in which they are traced.
  std::vector<ReferenceRay> spawned(const ReferenceRay& ray, const ReferenceHit& hit) const;
  /// Returns the number of rays traced so far, of all kinds.
  std::uint64_t rays() const { return rays_; }

 private:
  struct Touch;
  struct Ways;

  ReferenceHit trace(ReferenceRay& ray);
  std::vector<ReferenceRay> spawned(const Touch& met) const;
  Touch touch(const ReferenceRay& ray, const ReferenceHit& hit) const;
  ReferenceTexel look_up(const Touch& touch, const core::Texture& texture) const;
  core::Microfacets facets_of(const Touch& touch) const;
  ReferenceTexel paint_of(const Touch& touch) const;
  void finish(Touch& touch) const;
  core::Vec3d glow(const Touch& touch) const;
  ReferenceRay child(const Touch& touch, const core::Vec3d& towards, core::RayKind kind) const;
  void add_shadow_rays(const Touch& touch, std::vector<ReferenceRay>& rays) const;
  void add_children(const Touch& touch, std::vector<ReferenceRay>& rays) const;
  static Ways ways_of(const Touch& touch);
  static std::optional<core::Vec3d> scattered_direction(const Touch& touch);
  static double scattered_density(const Touch& touch, const core::Vec3d& towards);
  void add_light_sample_ray(const Touch& touch, std::vector<ReferenceRay>& rays) const;
  double mis_weight(const Touch& touch) const;
  std::optional<ReferenceRay> continued_by_facets(const Touch& touch, const core::SamplePair& choice) const;
  std::optional<ReferenceRay> continued(const Touch& touch, const core::SamplePair& choice) const;
  void add_path_ray(const Touch& touch, std::vector<ReferenceRay>& rays) const;
  core::Vec3d light_beyond(const ReferenceRay& ray) const;
  core::Vec3d sky(const core::Vec3d& direction) const;

  const ReferenceScene& scene_;
  const ReferenceFinder& finder_;
  core::ShadeOptions options_;
  RayWatcher* watcher_;
  std::uint64_t rays_ = 0;
};

}  // namespace dmpc::apps
