// Embree as a rival: asked as any renderer asks it, without what the oracle needs to name primitives beyond doubt.
#pragma once

#include <cstdint>
#include <span>

#include "apps/edge/system/stopwatch.h"
#include "apps/lab/bench/speed/bundled_rays.h"
#include "apps/oracle/embree.h"
#include "apps/oracle/oracle.h"
#include "core/database/database.h"
#include "core/record/ray.h"

namespace dmpc::apps {

/// What every traced ray is asked for.
enum class Query : std::uint8_t { closest, any };

/// What is known of rays that are asked about together: that they start or end near each other, as a picture's do, or nothing, as
/// of bounces. Embree walks with them accordingly; the wrong choice costs it much of its speed.
enum class Coherence : std::uint8_t { incoherent, coherent };

/// How much work Embree puts into its tree: its default, or all it can. In version 3 that adds spatial splits to fast trees, and
/// nothing to robust ones.
enum class EmbreeQuality : std::uint8_t { medium, high };

/// Its tree over the primitives of a database, as any renderer has it built: no filters, no order among equal t, no triangle left
/// out. Triangles come first, then spheres and cones as user geometry, if there are any. Immutable once built; every query is
/// thread-safe.
class EmbreeTree {
 public:
  /// `primitives` outlive it. Builds on `thread_count` threads, 0: on all cores. Throws InternalError if Embree reports an error.
  EmbreeTree(std::span<const core::PrimitiveValues> primitives, EmbreeMode mode, EmbreeQuality quality,
             std::uint32_t thread_count = 0);

  /// Asks about the rays, one by one, up to their t_max; returns how many hit.
  std::uint64_t trace(std::span<const core::Ray> rays, Query query) const;
  /// Traces bundles, each as a packet of up to 16 rays.
  std::uint64_t trace_packets(const BundleSpan& bundles, Query query, Coherence coherence) const;

  const embree::Library& library() const { return library_; }
  RTCScene scene() const { return tree_.scene(); }
  const embree::Shapes& shapes() const { return shapes_; }
  /// What Embree took to build it, from vertices that lay ready.
  const Times& build_times() const { return build_times_; }

 private:
  const embree::Library& library_ = embree::library();
  embree::Shapes shapes_;
  embree::OwnedScene tree_;
  Times build_times_;
};

}  // namespace dmpc::apps
