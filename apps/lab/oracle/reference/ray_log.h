// Every ray of a pixel with its answer, named so that the logs of two renderers can be compared.
#pragma once

#include <cstdint>
#include <vector>

#include "apps/lab/oracle/reference/camera.h"
#include "apps/lab/oracle/reference/finder.h"
#include "apps/lab/oracle/reference/scene.h"
#include "apps/lab/oracle/reference/tracer.h"
#include "core/database/database.h"
#include "core/picture/pixel_task.h"

namespace dmpc::apps {

struct LoggedRay {
  /// A hash of the kinds of all rays on the way to this one, the bodies that they hit, and for a shadow ray the light: it is the
  /// same in two logs if and only if both rays came the same way.
  std::uint64_t path = 0;
  std::uint64_t maker = 0;  ///< path of the ray whose hit this one starts from; 0 for a primary ray
  core::RayKind kind{};
  std::uint32_t light = 0;  ///< shadow ray only
  bool hit = false;
  std::uint32_t body = core::no_primitive;  ///< that was hit, an index into ReferenceScene::bodies
  double t = 0;                             ///< distance of the hit, in world units
  double t_max = 0;

  /// Returns whether both hit the same body; for shadow rays, whether both are blocked.
  bool agrees_with(const LoggedRay& other) const {
    return hit == other.hit && (!hit || kind == core::RayKind::shadow || body == other.body);
  }
};

/// In the order in which the rays were shot.
struct RayLog {
  std::vector<LoggedRay> rays;
  core::Vec3d radiance;

  /// Returns the ray with this `path`, if there is one.
  const LoggedRay* find(std::uint64_t path) const;
};

struct ProductLog : RayLog {
  std::vector<ReferenceRay> shots;  ///< in world coordinates, one for each of `rays`

  /// Returns the sum of what the rays without a hit bring: a shadow ray its light, any other the background's.
  core::Vec3d light(const core::Vec3d& background) const;
};

/// Returns the body of `scene` for each primitive of the database; no_primitive for one that double precision left out.
std::vector<std::uint32_t> bodies_of_primitives(const ReferenceScene& scene, const core::Database& database);

/// Runs the product's renderer, one pixel at a time.
class ProductLogger {
 public:
  /// All outlive the logger. `database` was built from `scene`.
  ProductLogger(const core::Database& database, const core::RenderSettings& settings, const ReferenceScene& scene);

  /// Returns the first sample's rays. Thread-safe.
  ProductLog log_of(std::uint32_t pixel) const;

 private:
  const core::Database& database_;
  core::RenderSettings settings_;
  std::vector<core::Vec3d> lights_;  ///< grid-local
  std::vector<std::uint32_t> bodies_;
};

/// Returns the reference renderer's log of one primary ray.
RayLog reference_log_of_rays(const ReferenceScene& scene, const ReferenceFinder& finder, const core::ShadeOptions& options,
                             const ReferenceRay& primary);

}  // namespace dmpc::apps
