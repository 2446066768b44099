// Embree's tree over the primitives of a database, as any renderer has it built: no filters, no order among equal t.
#pragma once

#include <cstdint>
#include <span>

#include "apps/lab/bench/speed/rival.h"
#include "apps/oracle/embree.h"

namespace dmpc::apps {

/// Triangles come first, then spheres and cones, if there are any. Immutable once built; every query is thread-safe.
class EmbreeTree {
 public:
  /// As EmbreeRival's.
  EmbreeTree(std::span<const core::PrimitiveValues> primitives, EmbreeMode mode, EmbreeQuality quality,
             std::uint32_t thread_count);

  const embree::Library& library() const { return library_; }
  RTCScene scene() const { return tree_.scene(); }
  const embree::Shapes& shapes() const { return shapes_; }
  /// From vertices that lay ready.
  const Times& build_times() const { return build_times_; }

 private:
  const embree::Library& library_ = embree::library();
  embree::Shapes shapes_;
  embree::OwnedScene tree_;
  Times build_times_;
};

}  // namespace dmpc::apps
