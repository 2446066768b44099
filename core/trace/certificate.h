// Proven bounds of a hit, computed in doubles without exact arithmetic: where the exact answer lies, and how far kernels may be
// off.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/base/interval.h"
#include "core/record/ray.h"
#include "core/record/record.h"

namespace dmpc::core {

/// Certifies the hit of one ray on one primitive.
///
/// The exact answer is in real numbers. The ray is O + t D, where O is the sum of `origin` and `origin_rest` and D that of
/// `direction` and `direction_rest`, neither rounded. A triangle is given by its nine floats, and t, u, v solve
///     O + t D = v0 + u (v1 - v0) + v (v2 - v0),
/// whether or not that lies on the triangle; 1 - u - v, u and v are the weights of v0, v1 and v2. There is no answer where the
/// ray is parallel to the plane, and no certificate for a triangle that is hit in a tilted plane that it shares
/// (core/database/faces/coplanar.h). A sphere's centre and radius are the sums of floats and rests (core/record/curved_values.h),
/// and t is the least positive root of |O + t D - centre| = radius, or the greater root if only the inside is visible. A cone's t
/// is the least positive one where O + t D is as far from the axis as the radius is there, between base and apex, and where the
/// ray leaves it if only the inside is visible.
struct Certificate {
  static constexpr double unknown = std::numeric_limits<double>::infinity();

  /// These hold the exact answer; unbounded where it may not exist. Only triangles have u and v.
  Interval t = Interval::everything(), u = Interval::everything(), v = Interval::everything();
  /// The t of a hit, as every kernel returns it, is no farther than this from the exact one.
  double t_error = unknown;
  /// Where a kernel reports a hit of a triangle, the exact edge functions D . ((b - O) x (c - O)), of the edges b c opposite v0,
  /// v1 and v2, have one sign, or are on the other side of 0 by no more than these: a ray may pass so far outside an edge and
  /// still hit in floats.
  std::array<double, 3> edge_error{unknown, unknown, unknown};

  /// False for a ray that doubles cannot tell from one that is parallel to the plane, tangent to the sphere or cone, or through
  /// the cone's rim.
  bool is_decided() const { return t.is_bounded(); }
  /// Whether the exact ray certainly meets the triangle itself.
  bool is_inside() const { return t.low > 0.0 && u.low >= 0.0 && v.low >= 0.0 && (Interval(1.0) - u - v).low >= 0.0; }
};

/// The certificate of `ray` with lane `lane` of a leaf's values, in the layout of core/trace/primitive.h. It follows from the ray
/// and the values, not from a hit; doubles only select the root of a curve. Its bounds are derived in certificate.cpp. Costs some
/// microseconds.
Certificate certify(const Ray& ray, PrimitiveKind kind, const float* rows, std::size_t stride, std::size_t lane);

}  // namespace dmpc::core
