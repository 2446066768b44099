// Spheres and cones against a ray in double precision: what the oracle tells Embree about shapes that Embree does not know.
#pragma once

#include <array>
#include <optional>

#include "core/database/database.h"
#include "core/record/ray.h"

namespace dmpc::apps {

/// The least distance in (0, t_max) at which `ray` meets the sphere, cone or cylinder `values`, in units of the ray's direction.
/// Works in double precision from the floats of the ray and of the record and shares no code with core's kernels. A negative
/// radius makes only the inside visible. Requires values.kind other than triangle. Thread-safe.
/// Source: the quadratic's two stable roots (Press et al., Numerical Recipes, section 5.6).
std::optional<double> nearest_on_curved(const core::PrimitiveValues& values, const core::Ray& ray);

/// An axis-aligned box around a primitive: lower x y z, upper x y z; rounded outwards in float.
std::array<float, 6> bounds_of_curved(const core::PrimitiveValues& values);

}  // namespace dmpc::apps
