// What is proven of a hit, in doubles and without exact arithmetic: where the exact answer lies, and how far the kernels may be
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
/// The exact answer is that of real numbers. The ray is O + t D, O the sum of `origin` and `origin_rest`, D that of `direction`
/// and `direction_rest`, neither rounded. A triangle's nine floats stand for themselves, and t, u, v solve
///     O + t D = v0 + u (v1 - v0) + v (v2 - v0),
/// whether or not that lies on the triangle; 1 - u - v, u and v are the weights of v0, v1 and v2. There is none where the ray is
/// parallel to the plane, and no certificate is of a triangle that is hit in a tilted plane that it shares
/// (core/database/faces/coplanar.h). A sphere's centre and radius are what floats and rests add up to
/// (core/record/curved_values.h), and t is the least positive root of |O + t D - centre| = radius, or the greater root if only
/// the inside is visible. A cone's t is the least positive one where O + t D is as far from the axis as the radius is there,
/// between base and apex, and where the ray gets out if only the inside is visible.
struct Certificate {
  static constexpr double unknown = std::numeric_limits<double>::infinity();

  /// They hold the exact answer; without ends where that cannot be told from none. Only triangles have u and v.
  Interval t = Interval::everything(), u = Interval::everything(), v = Interval::everything();
  /// A hit's t, as every kernel gives it, is no farther than this from the exact one.
  double t_error = unknown;
  /// Where a kernel sees a hit of a triangle the exact edge functions D . ((b - O) x (c - O)), of the edges b c opposite v0, v1
  /// and v2, have one sign, or are on the other side of 0 by no more than these: so far outside an edge a ray may pass whose
  /// floats say that it hits.
  std::array<double, 3> edge_error{unknown, unknown, unknown};

  /// Whether it says anything: not of a ray that doubles cannot tell from one parallel to the plane, tangent to the sphere or
  /// cone, or through the cone's rim.
  bool is_decided() const { return t.is_bounded(); }
  /// Whether the exact ray meets the triangle itself, beyond doubt.
  bool is_inside() const { return t.low > 0.0 && u.low >= 0.0 && v.low >= 0.0 && (Interval(1.0) - u - v).low >= 0.0; }
};

/// The certificate of `ray`, whatever of its hits, with lane `lane` of a leaf's values as core/trace/primitive.h takes them.
/// It follows from the ray and the values alone, but that doubles say near which root of a curve to look. Its bounds are derived
/// in certificate.cpp. Costs some microseconds.
Certificate certify(const Ray& ray, PrimitiveKind kind, const float* rows, std::size_t stride, std::size_t lane);

}  // namespace dmpc::core
