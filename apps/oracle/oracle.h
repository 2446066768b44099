// Embree as oracle: an independent answer to what a ray hits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "core/database/database.h"
#include "core/picture/pixel_task.h"
#include "core/record/hit.h"
#include "core/record/records.h"

namespace dmpc::apps {

/// Embree's own two settings: `robust` avoids leaks along edges and is what our grid is compared with; `fast` is the baseline.
enum class EmbreeMode : std::uint8_t { robust, fast };

/// All primitives of a database as an Embree scene: one triangle mesh without shared vertices, and one user geometry of spheres
/// and cones answered by apps/oracle/curved.h. Immutable once built; every query is thread-safe.
class EmbreeScene {
 public:
  /// `primitives` outlive the scene; their index is their id. Builds with all cores. Throws InternalError if Embree reports an
  /// error.
  EmbreeScene(std::span<const core::PrimitiveValues> primitives, EmbreeMode mode);
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  /// The hit with the least (t, primitive) in (0, ray.t_max) by Embree's own t, the triangle ray.ignored_primitive left out;
  /// `leaf` and `lane` stay unset. Among equal t Embree may have culled a lower id before it was tested. NaN or infinite rays
  /// miss.
  core::Hit closest(const core::Ray& ray) const;
  /// Whether anything but the triangle ray.ignored_primitive lies in (0, ray.t_max). NaN or infinite rays are free.
  bool occluded(const core::Ray& ray) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// A core::Tracer that asks Embree only to name the primitive; all that follows (geometry, shading) is our own arithmetic, so a
/// differing pixel means a differing primitive. Cheap to make, one for each node over one shared scene.
class EmbreeTracer {
 public:
  /// `places` and `frame` are the database's, and `local` is a whole copy of its records; all four outlive the tracer.
  EmbreeTracer(const EmbreeScene& scene, std::span<const core::Database::Place> places, const core::GridFrame& frame,
               core::LocalRecords local)
      : scene_(&scene), places_(places), frame_(&frame), local_(local) {}

  core::Traced trace(const core::Ray& ray, core::Cursor& cursor, core::Operations& operations);
  const std::byte* find(core::Address address) const { return local_.find(address); }

 private:
  float own_distance(const core::Ray& ray, const core::Hit& hit) const;

  const EmbreeScene* scene_;
  std::span<const core::Database::Place> places_;
  const core::GridFrame* frame_;
  core::LocalRecords local_;
};

/// Opens Embree, as the first scene would. Throws as open_module() does.
void open_embree();

/// Version of the Embree library that the module is linked with, for reports: "3.13.5".
const char* embree_version();

}  // namespace dmpc::apps
