// Every ray of a pixel with its answer, named so that the logs of two renderers can be laid side by side.
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
  /// Follows from the kinds of all rays on the way to this one, the bodies that they hit, and for a shadow ray the light: the
  /// same in two logs if and only if both came the same way.
  std::uint64_t path = 0;
  std::uint64_t maker = 0;  ///< path of the ray whose hit this one starts from; 0 for a primary ray
  core::RayKind kind{};
  std::uint32_t light = 0;  ///< shadow ray only
  bool hit = false;
  std::uint32_t body = core::no_primitive;  ///< that was hit, as an index into ReferenceScene::bodies
  double t = 0;                             ///< distance of the hit, in world units
  double t_max = 0;

  /// Whether both hit the same; of shadow rays, whether both are hidden.
  bool agrees_with(const LoggedRay& other) const {
    return hit == other.hit && (!hit || kind == core::RayKind::shadow || body == other.body);
  }
};

/// In the order in which the rays were shot.
struct RayLog {
  std::vector<LoggedRay> rays;
  core::Vec3d radiance;

  /// The ray that came by `path`, if one did.
  const LoggedRay* find(std::uint64_t path) const;
};

/// The product's.
struct ProductLog : RayLog {
  std::vector<ReferenceRay> shots;  ///< in world coordinates, one for each of `rays`

  /// The sum of what the rays bring that meet nothing: a shadow ray its light, any other the background's.
  core::Vec3d light(const core::Vec3d& background) const;
};

/// Which body of `scene` each primitive of the database is; no_primitive for one that double precision left out.
std::vector<std::uint32_t> bodies_of_primitives(const ReferenceScene& scene, const core::Database& database);

/// The product's renderer, one pixel at a time.
class ProductLogger {
 public:
  /// All outlive the logger. `scene` is what `database` was built of.
  ProductLogger(const core::Database& database, const core::RenderSettings& settings, const ReferenceScene& scene);

  /// The first sample's rays. Thread-safe.
  ProductLog log_of(std::uint32_t pixel) const;

 private:
  const core::Database& database_;
  core::RenderSettings settings_;
  std::vector<core::Vec3d> lights_;  ///< grid-local
  std::vector<std::uint32_t> bodies_;
};

/// The accurate renderer's log of one primary ray.
RayLog reference_log_of_rays(const ReferenceScene& scene, const ReferenceFinder& finder, const core::ShadeOptions& options,
                             const ReferenceRay& primary);

}  // namespace dmpc::apps
