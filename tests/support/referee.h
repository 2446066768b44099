// Brute force over triangles in double, independent of the kernels: between which t a right answer lies.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/vec.h"
#include "core/database/database.h"
#include "core/record/ray.h"
#include "tests/support/shooting.h"

namespace dmpc::tests {

/// No hit lies before `earliest`; if `latest` is finite there is a hit at or before it. Between the two rounding may decide.
struct Verdict {
  double earliest = std::numeric_limits<double>::infinity();
  double latest = std::numeric_limits<double>::infinity();

  bool allows(const core::Hit& hit, double tolerance) const {
    const double t = double{hit.t};
    return t >= earliest - tolerance && t <= latest + tolerance;
  }
};

/// Merges one triangle (Cramer's rule, normal form): surely hit if every weight exceeds `margin`, surely missed if one is below
/// -margin. A triangle seen nearly edge-on may be hit anywhere between its nearest and its farthest vertex.
inline void merge(Verdict& verdict, const core::PrimitiveValues& triangle, const core::Ray& ray, double margin) {
  const core::Vec3d origin(ray.origin), d(ray.direction);
  const core::Vec3d a = triangle.vector(0) - origin, b = triangle.vector(3) - origin, c = triangle.vector(6) - origin;
  const core::Vec3d normal = core::cross(b - a, c - a);
  const double facing = core::dot(normal, d), size = core::length(normal);
  const double weights[3] = {core::dot(core::cross(c, b), d), core::dot(core::cross(a, c), d), core::dot(core::cross(b, a), d)};
  const double slack = margin * std::sqrt(std::max({core::dot(a, a), core::dot(b, b), core::dot(c, c)})) *
                       std::sqrt(std::max({core::dot(b - a, b - a), core::dot(c - b, c - b), core::dot(a - c, a - c)}));
  const bool surely = (weights[0] > slack && weights[1] > slack && weights[2] > slack) ||
                      (weights[0] < -slack && weights[1] < -slack && weights[2] < -slack);
  const bool maybe = (weights[0] >= -slack && weights[1] >= -slack && weights[2] >= -slack) ||
                     (weights[0] <= slack && weights[1] <= slack && weights[2] <= slack);
  if (!maybe) {
    return;
  }
  const double depths[3] = {core::dot(a, d), core::dot(b, d), core::dot(c, d)};
  const double nearest = std::min({depths[0], depths[1], depths[2]}), farthest = std::max({depths[0], depths[1], depths[2]});
  const double t = std::clamp(core::dot(normal, a) / facing, nearest, farthest);
  const bool steep = std::fabs(facing) > 1e-3 * size;
  if (steep ? t > -margin : farthest > -margin) {
    verdict.earliest = std::min(verdict.earliest, std::max(0.0, steep ? t : nearest));
  }
  if (surely && steep && t > margin) {
    verdict.latest = std::min(verdict.latest, t);
  }
}

/// For a database of triangles alone.
inline Verdict judge(const core::Database& database, const core::Ray& ray, double margin) {
  Verdict verdict;
  for (const core::PrimitiveValues& triangle : database.primitives()) {
    merge(verdict, triangle, ray, margin);
  }
  return verdict;
}

}  // namespace dmpc::tests
