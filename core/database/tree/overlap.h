// Conservative tests whether a primitive's surface touches a box: no false negatives.
#pragma once

#include <algorithm>
#include <cstddef>

#include "core/base/box.h"
#include "core/database/database.h"

namespace dmpc::core {

/// For a triangle: exact.
inline Bounds triangle_bounds_of(const PrimitiveValues& triangle) {
  Bounds bounds;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float a = triangle.value[axis], b = triangle.value[3 + axis], c = triangle.value[6 + axis];
    bounds.low[axis] = std::min(std::min(a, b), c);
    bounds.high[axis] = std::max(std::max(a, b), c);
  }
  return bounds;
}
/// For other primitives.
Box other_bounds_of(const PrimitiveValues& primitive);

/// The primitive's bounding box, not padded.
inline Box bounds_of(const PrimitiveValues& primitive) {
  return primitive.kind == PrimitiveKind::triangle ? triangle_bounds_of(primitive).box() : other_bounds_of(primitive);
}
/// These bounds in single precision, rounded outwards.
Bounds rounded_bounds_of(const PrimitiveValues& primitive);

/// One primitive against many boxes, which are already enlarged by the pad; comparisons are inclusive. Triangles: separating
/// axes, T. Akenine-Moeller, "Fast 3D Triangle-Box Overlap Testing", 2001. Spheres: the shell's two radii against the box's
/// nearest and farthest point. Cones: distance of the box's centre to the lateral surface against half its diagonal.
class Overlap {
 public:
  explicit Overlap(const PrimitiveValues& primitive);
  bool touches(const Vec3d& center, const Vec3d& half) const;

 private:
  bool triangle(const Vec3d& center, const Vec3d& half) const;
  bool sphere(const Vec3d& center, const Vec3d& half) const;
  bool cone(const Vec3d& center, const Vec3d& half) const;

  PrimitiveKind kind_;
  Box bounds_;
  Vec3d a_, b_, c_;  ///< vertices, or centre, or base and axis
  Vec3d normal_;
  double radius_ = 0, apex_radius_ = 0;
};

}  // namespace dmpc::core
