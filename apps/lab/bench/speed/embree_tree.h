// Embree as a baseline, used as in any renderer, without what the oracle needs to identify primitives beyond doubt.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "apps/frontend/system/stopwatch.h"
#include "apps/lab/bench/speed/plain_quadric.h"
#include "apps/oracle/embree.h"
#include "apps/oracle/oracle.h"
#include "core/database/database.h"
#include "core/record/ray.h"

namespace dmpc::apps {

/// The query of every traced ray.
enum class Query : std::uint8_t { closest, any };

/// What a query's user geometry needs of its ray beside Embree's floats: curved mirrors multiply what rounding leaves.
struct PlainContext {
  embree::Context embree;  ///< first
  core::Vec3d origin, direction;

  PlainContext() { embree::start(embree); }
};

/// Shapes with the curved ones prepared, in Embree's numbering.
struct PlainShapes : embree::Shapes {
  std::vector<PlainQuadric> quadrics;

  explicit PlainShapes(std::span<const core::PrimitiveValues> primitives);
};

/// Embree's tree over the primitives of a database, of high quality, as any renderer builds it: no filters, no order among equal
/// t, no ignored triangle. Triangles come first, then spheres and cones as user geometry, if there are any. Immutable once built;
/// every query is thread-safe.
class EmbreeTree {
 public:
  /// `primitives` outlive it. Builds on all cores. Throws InternalError if Embree reports an error.
  EmbreeTree(std::span<const core::PrimitiveValues> primitives, EmbreeMode mode);

  /// Traces the rays, one by one, up to their t_max; returns how many hit.
  std::uint64_t trace(std::span<const core::Ray> rays, Query query) const;

  const embree::Library& library() const { return library_; }
  RTCScene scene() const { return tree_.scene(); }
  const PlainShapes& shapes() const { return shapes_; }
  /// Returns the times that Embree needed to build it from prepared vertices.
  const Times& build_times() const { return build_times_; }

 private:
  const embree::Library& library_ = embree::library();
  PlainShapes shapes_;
  embree::OwnedScene tree_;
  Times build_times_;
};

}  // namespace dmpc::apps
