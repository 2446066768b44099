// Intersection of one ray with up to 8 boxes or primitives of one record; SIMD where the machine has it, with the scalar twins'
// bits.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>

#include "core/record/hit.h"
#include "core/record/ray.h"
#include "core/record/record.h"
#include "core/trace/cursor.h"
#include "core/trace/curved_reach.h"
#include "core/trace/operations.h"
#include "core/trace/primitive.h"

namespace dmpc::core {

/// A ray as box tests need it, from reciprocal_direction(): with a component near 0 it crosses the planes of a box that it lies
/// between far behind and far ahead.
struct BoxRay {
  BoxRay(const Ray& ray, const Vec3d& reciprocal_direction);

  Vec3f origin, reciprocal;
  std::array<std::uint32_t, 3> near_row{}, far_row{};  ///< which rows of a BVH node's bounds the ray crosses first and last
};

/// Returns one of a BVH node's children whose boxes the ray meets in [t_low, t_high], if any, and adds the others to the waiting
/// ones. With `in_order` it returns the nearest, and the nearest of the others is last; otherwise any. A ray enters a box at
/// t_low or later; waiting.t_taken is where it enters that of the returned child. Planes are off by less than 2^-22 of their
/// distance from the origin, for which the insertion pad around the boxes compensates.
using BvhNodeKernel = BvhChild (*)(const BoxRay& ray, const BvhNode& bvh_node, float t_low, float t_high, bool in_order,
                                   MetChildren& waiting);
/// The fastest kernel for this processor.
extern const BvhNodeKernel meet_children;
/// The plain loop: the twin that every SIMD kernel must equal.
BvhChild meet_children_scalar(const BoxRay& ray, const BvhNode& bvh_node, float t_low, float t_high, bool in_order,
                              MetChildren& waiting);

/// The triangles of a leaf: nine rows of `count` floats, then a row of ids, readable for overread_bytes behind.
struct TriangleRows {
  const float* rows;
  std::size_t count;
  std::uint32_t left_out = 0;  ///< a bit for each triangle that bundles do not test

  const std::byte* ids() const { return reinterpret_cast<const std::byte*>(rows + 9 * count); }
};

/// A bit for each triangle that the ray hits at a t in (0, t_most], except the one with id `ignored`; times[lane] is its t.
/// `times` holds 8 values.
using TriangleKernel = std::uint32_t (*)(const ShearedRay& ray, const TriangleRows& triangles, std::uint32_t ignored,
                                         float t_most, float* times);
/// The fastest kernel for this processor.
extern const TriangleKernel hit_triangles;
/// The plain loop over intersect_triangle: the twin that every SIMD kernel must equal.
std::uint32_t hit_triangles_scalar(const ShearedRay& ray, const TriangleRows& triangles, std::uint32_t ignored, float t_most,
                                   float* times);

/// Tests the triangles of a leaf that share their planes, in scalar code: sets only their bits and times.
std::uint32_t hit_shared_faces(const ShearedRay& ray, const std::byte* record, std::uint32_t ignored, float t_most, float* times);

/// Tests the spheres or cones of a leaf that the ray may meet, in scalar code.
std::uint32_t hit_curved(const Ray& ray, const CurvedRows& curved, float t_most, float* times);

/// The instruction set of the kernels here, for reports: "AVX3", "AVX2" or "scalar".
const char* simd_name();

/// Merges the hits of `ray` with the leaf at `record` (with address `leaf`) into `best`: the least (t, primitive) with t in (0,
/// ray.t_max), without the ignored primitive. Order and repetition of calls do not change the result.
inline void test_leaf(const Ray& ray, const ShearedRay& sheared, const std::byte* record, Address leaf, Hit& best,
                      Operations& operations) {
  const auto header = read<LeafHeader>(record);
  const auto* rows = reinterpret_cast<const float*>(record + sizeof(LeafHeader));
  const std::size_t count = header.count;
  float times[leaf_lanes];
  operations.primitive_tests[static_cast<std::size_t>(header.kind)] += count;
  const float t_most = std::min(best.t, ray.t_max);
  std::uint32_t hits = header.kind == PrimitiveKind::triangle
                           ? hit_triangles(sheared, {rows, count}, ray.ignored_primitive, t_most, times)
                           : hit_curved(ray, {header.kind, rows, count}, t_most, times);
  if (header.shared_lanes != 0) {
    const std::uint32_t shared = hit_shared_faces(sheared, record, ray.ignored_primitive, t_most, times);
    hits = (hits & ~std::uint32_t{header.shared_lanes}) | shared;
  }
  const auto* ids = reinterpret_cast<const std::uint32_t*>(ids_of(header, record));
  for (; hits != 0; hits &= hits - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(hits));
    const float t = times[lane];
    if (t < ray.t_max && replaces(t, ids[lane], best) && ids[lane] != ray.ignored_primitive) {
      best = {t, ids[lane], leaf, static_cast<std::uint32_t>(lane)};
    }
  }
}

}  // namespace dmpc::core
