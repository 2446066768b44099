// The light that a ray brings, in double precision throughout: NFF's surfaces as Haines defines them, written anew from the
// definition, as what core's shading is measured against.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "apps/lab/oracle/accurate/finder.h"
#include "apps/lab/oracle/accurate/scene.h"
#include "core/picture/path_step.h"
#include "core/picture/sample_pair.h"
#include "core/picture/shade.h"

namespace dmpc::apps {

/// Sees, and may disturb, every ray of a tracer. Rays come in the order of the product: depth first, a hit's shadow rays in the
/// order of the lights, then its reflected ray with all that follows from it, then the refracted one.
class RayWatcher {
 public:
  virtual ~RayWatcher() = default;

  /// A ray is about to be traced.
  virtual void shoot(AccurateRay&) {}
  /// A ray that is no shadow ray met `body` here.
  virtual void touch(const AccurateRay&, const AccurateBody&, AccurateSurface&) {}
  /// A texture is about to be looked up there.
  virtual void look_up(AccurateFootprint&) {}
  /// A ray was traced.
  virtual void end(const AccurateRay&, const AccurateHit&) {}
};

/// Not thread-safe: one a thread.
class AccurateTracer {
 public:
  /// All outlive the tracer; `watcher` may be null. Secondary rays start 1e-13 of their body's coordinates and radius off it.
  /// Rays look at textures as the product's first samples do, by what the ray's own camera says that a pixel covers; where the
  /// options give them no share of it, at points. By paths rays have the chances of the product's, if its grid has the world's
  /// axes.
  AccurateTracer(const AccurateScene& scene, const AccurateFinder& finder, const core::ShadeOptions& options,
                 RayWatcher* watcher = nullptr)
      : scene_(scene), finder_(finder), options_(options), watcher_(watcher) {}

  /// Linear radiance that a ray brings, with all rays that follow from it.
  core::Vec3d radiance(AccurateRay ray);
  /// What a hit sends back along `ray`, which is no shadow ray, by itself: its own light, and of the ambient one
  /// what its diffuse part reflects.
  core::Vec3d glow(const AccurateRay& ray, const AccurateHit& hit) const;
  /// The rays that start where `ray`, which is no shadow ray, meets `hit`, in the order in which they are traced.
  std::vector<AccurateRay> spawned(const AccurateRay& ray, const AccurateHit& hit) const;
  /// Rays traced so far, of all kinds.
  std::uint64_t rays() const { return rays_; }

 private:
  struct Touch;
  struct Ways;

  AccurateHit trace(AccurateRay& ray);
  std::vector<AccurateRay> spawned(const Touch& met) const;
  Touch touch(const AccurateRay& ray, const AccurateHit& hit) const;
  AccurateTexel look_up(const Touch& touch, const core::Texture& texture) const;
  core::Microfacets facets_of(const Touch& touch) const;
  AccurateTexel paint_of(const Touch& touch) const;
  void finish(Touch& touch) const;
  core::Vec3d glow(const Touch& touch) const;
  AccurateRay child(const Touch& touch, const core::Vec3d& towards, core::RayKind kind) const;
  void add_shadow_rays(const Touch& touch, std::vector<AccurateRay>& rays) const;
  void add_children(const Touch& touch, std::vector<AccurateRay>& rays) const;
  static Ways ways_of(const Touch& touch);
  static std::optional<core::Vec3d> scattered_direction(const Touch& touch);
  static double scattered_density(const Touch& touch, const core::Vec3d& towards);
  void add_aimed_ray(const Touch& touch, std::vector<AccurateRay>& rays) const;
  double share_met(const Touch& touch) const;
  std::optional<AccurateRay> continued_by_facets(const Touch& touch, const core::SamplePair& choice) const;
  std::optional<AccurateRay> continued(const Touch& touch, const core::SamplePair& choice) const;
  void add_path_ray(const Touch& touch, std::vector<AccurateRay>& rays) const;
  core::Vec3d light_beyond(const AccurateRay& ray) const;
  core::Vec3d sky(const core::Vec3d& direction) const;

  const AccurateScene& scene_;
  const AccurateFinder& finder_;
  core::ShadeOptions options_;
  RayWatcher* watcher_;
  std::uint64_t rays_ = 0;
};

}  // namespace dmpc::apps
