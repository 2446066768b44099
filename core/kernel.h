// Intersection of one ray with one block of up to 8 primitives; SIMD where the machine has it, with the scalar twins' bits.
#pragma once

#include <cstddef>

#include "core/hit.h"
#include "core/operations.h"
#include "core/primitive.h"
#include "core/ray.h"
#include "core/record.h"

namespace dmpc::core {

/// Merges the hits of `ray` with the block at `record` (whose address is `block`) into `best`: the least (t, primitive) with t in
/// (0, ray.t_max), the ignored primitive left out. Order and repetition of calls do not change the result.
void test_block(const Ray& ray, const ShearedRay& sheared, const std::byte* record, Address block, Hit& best,
                Operations& operations);

/// t of all lanes of a triangle block: `times[lane]`, `missed` or any value outside (0, t_max) where there is no hit.
/// `rows` is readable for overread_bytes behind the last row.
using TriangleKernel = void (*)(const ShearedRay& ray, const float* rows, std::size_t count, float* times);

/// The plain loop over intersect_triangle: the twin that every SIMD kernel must equal.
void triangles_scalar(const ShearedRay& ray, const float* rows, std::size_t count, float* times);
/// The fastest kernel for this processor.
void triangles_simd(const ShearedRay& ray, const float* rows, std::size_t count, float* times);
/// The instruction set that triangles_simd uses here, for reports: "AVX3", "AVX2" or "scalar".
const char* simd_name();

}  // namespace dmpc::core
