// Intersects a ray with a primitive in higher precision, and bounds exactly what float rounding may have changed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/database/database.h"
#include "core/record/ray.h"

namespace dmpc::apps {

/// The renderer whose float rounding is the unit of a margin: our grid's kernels or Embree's robust ones (with our callbacks for
/// curves).
enum class Renderer : std::uint8_t { grid, embree };

/// Where a ray meets, or narrowly misses, a primitive. The arithmetic shares nothing with core's kernels: double for triangles
/// (long double where a sign is in doubt), long double for spheres and cones.
struct ExactIntersection {
  std::uint32_t primitive = core::no_primitive;
  double t = 0;        ///< in units of the ray's direction
  double t_error = 0;  ///< the most by which rounding in either renderer moves t
  /// How far the ray is inside the silhouette, in units of that renderer's rounding bound: from 1 up the renderer must see the
  /// hit, from -1 down it must not, and in between rounding decides. Indexed by Renderer.
  std::array<double, 2> margin{};
  bool exact = false;   ///< the exact answer: inside the silhouette (edges included) and t in (0, t_max)
  bool at_end = false;  ///< t is within t_error of 0 or of t_max, so that rounding decides whether it counts

  bool possible(Renderer renderer) const { return margin[static_cast<std::size_t>(renderer)] > -1; }
  bool certain(Renderer renderer) const { return margin[static_cast<std::size_t>(renderer)] >= 1 && !at_end; }
};

/// Appends the exact intersections of `ray` with `primitive` that rounding may make a hit for one of the renderers: none or one
/// for a triangle, up to two for a sphere or a cone. `exact`: the plane of a triangle that only doubles distinguish from others,
/// none for any other primitive. The bounds are derived in exact_intersection.cpp. Thread-safe.
void add_exact_intersections(const core::Ray& ray, const core::PrimitiveValues& values, std::uint32_t primitive,
                             std::vector<ExactIntersection>& exact_intersections, const core::FacePlane* exact = nullptr);

/// For reports: returns the exact intersection with the greatest margin, whether or not it is a hit. A ray that does not meet a
/// curved primitive's full surface at all has margins of minus infinity.
ExactIntersection examine(const core::Ray& ray, const core::PrimitiveValues& values, std::uint32_t primitive,
                          const core::FacePlane* exact = nullptr);

}  // namespace dmpc::apps
