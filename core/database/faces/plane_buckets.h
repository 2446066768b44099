// Triangles that may lie in one plane, found by what their planes are like.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/database/faces/face.h"
#include "core/database/faces/plane_lanes.h"

namespace dmpc::core {

/// Faces of different objects with similar planes: a range of PlaneBuckets::faces.
struct PlaneBucket {
  std::size_t axis = 0;  ///< along which all of them can be tested
  std::size_t first = 0, last = 0;
};

/// Planes as points of a space, two slopes and a height, in buckets. A face is in all buckets where its plane may be with any
/// rounding of its corners, so two faces in one plane share a bucket.
struct PlaneBuckets {
  std::vector<std::uint32_t> faces;  ///< ascending within a bucket
  std::vector<PlaneBucket> buckets;

  std::span<const std::uint32_t> faces_of(const PlaneBucket& bucket) const {
    return std::span(faces).subspan(bucket.first, bucket.last - bucket.first);
  }
};

/// Buckets with faces of more than one object; of several with the same faces the first.
PlaneBuckets fill_plane_buckets(std::span<const Face> faces, const BucketSize& size = fine_buckets);

}  // namespace dmpc::core
