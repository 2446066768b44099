// Triangles that may lie in one plane, found by what their planes are like.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/parallel.h"
#include "core/build/conversion.h"

namespace dmpc::core {

/// Triangles of different objects whose planes are alike: those between two places of PlaneBuckets::ids.
struct PlaneBucket {
  std::size_t axis = 0;  ///< that all of them can be looked at along
  std::size_t first = 0, last = 0;
};

/// Planes as points of a space: two slopes and a height, in buckets. A triangle is in all buckets where its plane may be, for all
/// that rounding did to its corners, so two that lie in one plane meet in a bucket.
struct PlaneBuckets {
  std::vector<std::uint32_t> ids;  ///< ascending within a bucket
  std::vector<PlaneBucket> buckets;

  std::span<const std::uint32_t> ids_of(const PlaneBucket& bucket) const {
    return std::span(ids).subspan(bucket.first, bucket.last - bucket.first);
  }
};

/// Buckets of more than one triangle, of more than one object. The same whatever the number of threads.
PlaneBuckets fill_plane_buckets(const Conversion& conversion, const Parallel& parallel);

}  // namespace dmpc::core
