// Our own ways to a ray's hit, which need no Embree.
#pragma once

#include <array>
#include <cstddef>

#include "core/database/database.h"
#include "core/record/hit.h"
#include "core/record/ray.h"

namespace dmpc::apps {

inline constexpr std::size_t own_kernel_count = 6;

/// By StabilityKernel, of which these are the first: grid, scalar, plain, resumed, bundle, any_hit. Of `any_hit` only found()
/// means anything.
using OwnAnswers = std::array<core::Hit, own_kernel_count>;

/// `ray` with another kind.
inline core::Ray of_kind(core::Ray ray, core::RayKind kind) {
  ray.kind = kind;
  return ray;
}

/// The third of four rays in a bundle. The others go nearly the same way or, beside every second ray, some other ways.
core::Hit shoot_in_bundle(const core::Database& database, const core::Ray& ray);

/// One ray through each of them. Closest hits for all but `any_hit`, whatever the ray's kind, as of a mirrored ray: the eye's
/// alone may start on a curved surface without meeting it there. Thread-safe.
OwnAnswers ask_own_kernels(const core::Database& database, const core::Ray& ray);

}  // namespace dmpc::apps
