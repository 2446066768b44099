// Our own ways of computing a ray's hit, which do not need Embree.
#pragma once

#include <array>
#include <cstddef>

#include "core/database/database.h"
#include "core/record/hit.h"
#include "core/record/ray.h"

namespace dmpc::apps {

inline constexpr std::size_t own_kernel_count = 6;

/// By StabilityKernel, of which these are the first: grid, scalar, plain, resumed, bundle, any_hit. For `any_hit` only found()
/// has a meaning.
using OwnAnswers = std::array<core::Hit, own_kernel_count>;

/// Returns `ray` with another kind.
inline core::Ray of_kind(core::Ray ray, core::RayKind kind) {
  ray.kind = kind;
  return ray;
}

/// Traces the ray as the third of four in a bundle. The others have nearly the same direction or, with every second ray, other
/// directions.
core::Hit shoot_in_bundle(const core::Database& database, const core::Ray& ray);

/// Traces one ray with each of them. All except `any_hit` return closest hits, whatever the ray's kind, as for a mirrored ray:
/// only a ray from the eye may start on a curved surface without hitting it there. Thread-safe.
OwnAnswers ask_own_kernels(const core::Database& database, const core::Ray& ray);

}  // namespace dmpc::apps
