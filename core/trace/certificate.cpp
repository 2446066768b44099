// Derivation of the bounds. e = 2^-24 is half a unit in the last place of 1 in float, g(n) = n e / (1 - n e) bounds what n
// roundings add up to (N. J. Higham, Accuracy and Stability of Numerical Algorithms, 2002, lemma 3.1), h = 2^-150 is what a
// rounded float may be off besides where it is denormal. Everything below is computed in intervals, so the bounds themselves are
// not rounded the wrong way.
//
// The exact answer of a triangle is T. Moeller and B. Trumbore's quotient of determinants ("Fast, Minimum Storage Ray/Triangle
// Intersection", 1997), in intervals.
//
// How far the kernels are off: S. Woop, C. Benthin and I. Wald's test ("Watertight Ray/Triangle Intersection", 2013) rounding by
// rounding, each bounded by the numbers of this ray and triangle where their paper and T. Ize ("Robust BVH Ray Traversal", 2013)
// bound them by the largest coordinate. Let p = A - origin be a vertex in reals, P = A - O the same of the ray in full, the axes
// in the ray's order; r the origin's rest, S = d / d_z the slopes of the ray's floats, S* = D / D_z those of the ray in full.
//
// 1. A sheared vertex. Its p is off by e |p|; the slope, a quotient and a product, by g(2) |S| + h; its product with p_z and the
//    sum are fused, one rounding. So x^ = fl(p_x - S_x p_z) is off by
//        m + e (|x| + m) + h,   m = e |p_x| + g(3) |S_x p_z| + 2 h |p_z|,   x = p_x - S_x p_z,
//    and x from its like of the ray in full, x* = P_x - S*_x P_z, by  r_x + (S* - S)_x p_z - S*_x r_z.
//    The sum of the magnitudes is E(x) here, and M(x) = |x*| + E(x) bounds both x^ and x*.
// 2. An edge function b_x c_y - b_y c_x. Its vertices cost E(b_x) M(c_y) + M(b_x) E(c_y) and as much for the other product, its
//    own two products and the difference, unfused, g(2) of their magnitudes and 4 h. With exact signs in double it is off by
//    less. The sum over both products is F here, one for each edge: F0 opposite v0.
// 3. The edges. A kernel sees a hit only where its three edge functions have one sign, or are 0. So the exact ones, U0, U1, U2,
//    are no farther on the other side than F0, F1, F2. Their sum is N; D . (P_b x P_c) is D_z times theirs.
// 4. The distance. With edge functions of one sign their sum is good to g(2), a weight to g(3) of itself. With the roundings of
//    p_z, three more of the fused sums, of the reciprocal of d_z and of the last product
//        |t^ - (w0 p0_z + w1 p1_z + w2 p2_z) / d_z| <= g(9) max |p_z| / |d_z| + 4 h (max |p_z| + 1) (1 + 1 / |d_z|),
//    w the quotients of what the edge functions are in floats: positive, of sum 1. So a common part of p_z comes out whole:
//    p_z - P_z = r_z costs |r_z / D_z|, the directions' 1 / d_z - 1 / D_z that much of p_z. And with z* = t* D_z
//        w0 P0_z + w1 P1_z + w2 P2_z - z* = sum of (w - w*) (P_z - z*) <= sum of F |P_z - z*| / (|N| - F0 - F1 - F2),
//    or, since w are positive, no more than |P_z - z*| of the vertex that is farthest from z*: the lesser counts.
// 5. Next to the ray's start (near_start) doubles may have decided t by another formula, judged() in primitive.cpp. Its
//    operations are put through intervals, and t is off by no more than these are from t*, and e |t| + h.
//
// A sphere's polynomial f(t) = |P|^2 - radius^2, P = O + t D - centre, is evaluated in intervals on both sides of what
// sphere_distance() says. Where it surely changes its sign a root lies between; the kernels' t is what lies in the middle,
// rounded once. A cone's, with P = O + t D - base, a its axis, L = a.a and w what it widens by, is
//     f(t) = L |P x a|^2 - (radius L + w P.a)^2,
// L^2 times the square of P's distance from the axis less that of the radius there. The other root follows from the sum of both.
#include "core/trace/certificate.h"

#include <algorithm>
#include <cmath>

#include "core/base/vec.h"
#include "core/record/curved_values.h"
#include "core/trace/primitive.h"

namespace dmpc::core {
namespace {

using Reals = Vec3<Interval>;

constexpr double unit_rounding = 0x1p-24;
constexpr double denormal_unit = 0x1p-150;
/// g(n) for n up to 16: n e <= 2^-20, and 1 / (1 - 2^-20) < 1 + 2^-19.
constexpr double gamma(int n) { return n * unit_rounding * (1 + 0x1p-19); }

Reals exactly(const Vec3f& v) { return {Interval(double{v.x}), Interval(double{v.y}), Interval(double{v.z})}; }

/// Whether the direction's reciprocals neither overflow nor are denormal; this holds for rays of about unit length.
bool has_usual_direction(const Ray& ray) {
  constexpr float least = 0x1p-100F, most = 0x1p100F;
  const float largest = largest_component(ray.direction);
  return largest >= least && largest <= most && is_finite(ray.direction_rest) && is_finite(ray.origin) &&
         is_finite(ray.origin_rest);
}

/// A ray and a triangle in reals; the triangle is relative to the ray's full origin.
struct RealTriangle {
  RealTriangle(const Ray& ray, const float* rows, std::size_t stride, std::size_t lane)
      : direction(exactly(ray.direction) + exactly(ray.direction_rest)) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double at = double{rows[(3 * corner + axis) * stride + lane]};
        vertex[corner][axis] = Interval(at);
        seen[corner][axis] = Interval(at) - Interval(double{ray.origin[axis]}) - Interval(double{ray.origin_rest[axis]});
      }
    }
  }

  /// Whether no float can overflow in between.
  bool is_near() const {
    constexpr double far = 0x1p40;
    return std::all_of(seen.begin(), seen.end(),
                       [](const Reals& at) { return at.x.most() <= far && at.y.most() <= far && at.z.most() <= far; });
  }

  Reals direction;
  std::array<Reals, 3> vertex, seen;
};

/// Sets t, u and v. Returns the determinant D . (edge2 x edge1): |D_z| times the sum of the exact edge functions, except for its
/// sign.
Interval solve(const RealTriangle& real, Certificate& certificate) {
  const Reals edge1 = real.vertex[1] - real.vertex[0], edge2 = real.vertex[2] - real.vertex[0], from_v0 = -real.seen[0];
  const Reals p = cross(real.direction, edge2), q = cross(from_v0, edge1);
  const Interval determinant = dot(edge1, p);
  certificate.t = dot(edge2, q) / determinant;
  certificate.u = dot(from_v0, p) / determinant;
  certificate.v = dot(real.direction, q) / determinant;
  return determinant;
}

/// A number of the kernel: its exact value for the ray in full, and the maximum error of the float.
struct Rounded {
  Interval exact, error;

  /// An upper bound of the magnitude of both.
  Interval most() const { return magnitude(exact) + error; }
};

/// A triangle sheared as in the kernels, with its errors.
class KernelTriangle {
 public:
  KernelTriangle(const Ray& ray, const RealTriangle& real) : ray_(ray), sheared_(ray), real_(real) {}

  /// Sheared coordinate `axis` of a vertex, x or y.
  Rounded sheared(std::size_t corner, std::uint32_t axis) const {
    const std::uint32_t z = sheared_.axis_z;
    const Interval slope = direction(axis) / direction(z), full_slope = real_.direction[axis] / real_.direction[z];
    const Interval px = float_seen(corner, axis), pz = float_seen(corner, z);
    const Interval moved = unit_rounding * magnitude(px) + gamma(3) * magnitude(slope * pz) + 2 * denormal_unit * magnitude(pz);
    const Interval by_rounding = moved + unit_rounding * (magnitude(px - slope * pz) + moved) + denormal_unit;
    // As one quotient, since the two slopes nearly cancel.
    const Interval slope_rest = (rest(axis) * direction(z) - direction(axis) * rest(z)) / (direction(z) * real_.direction[z]);
    const Interval by_rests = origin_rest(axis) + slope_rest * pz - full_slope * origin_rest(z);
    return {real_.seen[corner][axis] - full_slope * real_.seen[corner][z], by_rounding + magnitude(by_rests)};
  }

  /// F of the edge opposite `corner`; see 2. above.
  Interval edge_error(std::size_t corner) const {
    const std::size_t b = (corner + 1) % 3, c = (corner + 2) % 3;
    const Rounded bx = sheared(b, sheared_.axis_x), by = sheared(b, sheared_.axis_y);
    const Rounded cx = sheared(c, sheared_.axis_x), cy = sheared(c, sheared_.axis_y);
    return product_error(bx, cy) + product_error(by, cx) + 4 * denormal_unit;
  }

  /// The maximum error of the float t of 4.; `area` is |N| and `edge_error` are F.
  Interval distance_error(const Interval& t, const Interval& area, const std::array<Interval, 3>& edge_error) const {
    const std::uint32_t z = sheared_.axis_z;
    const Interval exact_z = t * real_.direction[z];
    Interval depth, tilt, farthest;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Interval apart = magnitude(real_.seen[corner][z] - exact_z);
      depth = larger(depth, magnitude(float_seen(corner, z)));
      farthest = larger(farthest, apart);
      tilt = tilt + edge_error[corner] * apart;
    }
    const Interval sure_area = area - edge_error[0] - edge_error[1] - edge_error[2];
    const double by_tilt = sure_area.low > 0.0 ? (tilt / sure_area).high : Certificate::unknown;
    const Interval by_edges(0.0, std::min(by_tilt, farthest.high));
    const Interval by_rounding =
        gamma(9) * depth / magnitude(direction(z)) + 4 * denormal_unit * (depth + 1.0) * (1.0 + 1.0 / magnitude(direction(z)));
    const Interval by_rest = depth * magnitude(rest(z)) / magnitude(direction(z) * real_.direction[z]);
    return by_rounding + by_rest + (magnitude(origin_rest(z)) + by_edges) / magnitude(real_.direction[z]);
  }

  /// The bound of the error of judged(), 5. above: SeenTriangle::plane_distance() in intervals.
  Interval judged_error(const Interval& t) const {
    const Reals shear{Interval(double{sheared_.shear_x}), Interval(double{sheared_.shear_y}), Interval(1.0)};
    const std::array<Reals, 3> at{in_order(0), in_order(1), in_order(2)};
    const Reals normal = cross(at[1] - at[0], at[2] - at[0]);
    const Interval depth = dot(normal, at[0]) / dot(normal, shear);
    const double least = std::min({at[0].z.low, at[1].z.low, at[2].z.low}),
                 greatest = std::max({at[0].z.high, at[1].z.high, at[2].z.high});
    const Interval clamped(std::clamp(depth.low, least, greatest), std::clamp(depth.high, least, greatest));
    const Interval judged = clamped * Interval(double{sheared_.scale_z});
    return magnitude(judged - t) + unit_rounding * magnitude(judged) + denormal_unit;
  }

  double direction_most() const { return magnitude(real_.direction[sheared_.axis_z]).high; }

 private:
  static Interval larger(const Interval& a, const Interval& b) { return {std::max(a.low, b.low), std::max(a.high, b.high)}; }
  static Interval product_error(const Rounded& a, const Rounded& b) {
    return a.error * b.most() + a.most() * b.error + gamma(2) * a.most() * b.most();
  }

  Interval direction(std::uint32_t axis) const { return double{ray_.direction[axis]}; }
  Interval rest(std::uint32_t axis) const { return double{ray_.direction_rest[axis]}; }
  Interval origin_rest(std::uint32_t axis) const { return double{ray_.origin_rest[axis]}; }
  Interval float_seen(std::size_t corner, std::uint32_t axis) const {
    return real_.vertex[corner][axis] - Interval(double{ray_.origin[axis]});
  }
  Reals in_order(std::size_t corner) const {
    const Reals& seen = real_.seen[corner];
    return {seen[sheared_.axis_x], seen[sheared_.axis_y], seen[sheared_.axis_z]};
  }

  const Ray& ray_;
  ShearedRay sheared_;
  const RealTriangle& real_;
};

Certificate certify_triangle(const Ray& ray, const float* rows, std::size_t stride, std::size_t lane) {
  const RealTriangle real(ray, rows, stride, lane);
  Certificate certificate;
  const Interval determinant = solve(real, certificate);
  if (!certificate.is_decided() || !real.is_near()) {
    return {};
  }
  const KernelTriangle kernel(ray, real);
  const std::array<Interval, 3> edge_error{kernel.edge_error(0), kernel.edge_error(1), kernel.edge_error(2)};
  const Interval area = magnitude(determinant) / kernel.direction_most();
  for (std::size_t corner = 0; corner < 3; ++corner) {
    certificate.edge_error[corner] = (edge_error[corner] * kernel.direction_most()).high;
  }
  certificate.t_error = kernel.distance_error(certificate.t, area, edge_error).high;
  if (certificate.t.least() - certificate.t_error < double{near_start}) {
    certificate.t_error = std::max(certificate.t_error, kernel.judged_error(certificate.t).high);
  }
  return certificate;
}

/// f above, and half its slope, which is positive where a ray leaves the sphere.
struct RealSphere {
  RealSphere(const Ray& ray, const CurvedValues& sphere)
      : direction(exactly(ray.direction) + exactly(ray.direction_rest)), radius(sphere.value(3)) {
    const Vec3d center = sphere.vector(0);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      from_center[axis] = Interval(double{ray.origin[axis]}) - Interval(center[axis]) + Interval(double{ray.origin_rest[axis]});
    }
  }

  Interval value(double t) const {
    const Reals at = from_center + direction * Interval(t);
    return dot(at, at) - radius * radius;
  }
  Interval half_slope(double t) const { return dot(from_center + direction * Interval(t), direction); }

  Reals direction, from_center;
  Interval radius;
};

/// The sign of all numbers in an interval; 0 if they have none in common.
int sign_of(const Interval& a) { return a.low > 0.0 ? 1 : a.high < 0.0 ? -1 : 0; }

struct RealCone {
  RealCone(const Ray& ray, const CurvedValues& cone)
      : direction(exactly(ray.direction) + exactly(ray.direction_rest)), radius(std::fabs(cone.value(3))) {
    const Vec3d base = cone.vector(0), apex = cone.vector(4), apex_from = cone.is_flat() ? Vec3d{} : base;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      from_base[corner] =
          Interval(double{ray.origin[corner]}) - Interval(base[corner]) + Interval(double{ray.origin_rest[corner]});
      axis[corner] = Interval(apex[corner]) - Interval(apex_from[corner]);
    }
    axis_squared = dot(axis, axis);
    widening = Interval(std::fabs(cone.value(7))) - radius;
    across_rate = cross(direction, axis);
    rise = dot(direction, axis);
  }

  Reals at(const Interval& t) const { return from_base + direction * t; }
  /// L times the radius at this point.
  Interval wide(const Reals& at) const { return radius * axis_squared + widening * dot(at, axis); }
  Interval value(double t) const {
    const Reals point = at(Interval(t)), across = cross(point, axis);
    return axis_squared * dot(across, across) - wide(point) * wide(point);
  }
  Interval half_slope(const Interval& t) const {
    const Reals point = at(t);
    return axis_squared * dot(cross(point, axis), across_rate) - wide(point) * widening * rise;
  }
  /// The root other than `t`.
  Interval other_root(const Interval& t) const {
    const Interval bend = axis_squared * dot(across_rate, across_rate) - widening * rise * (widening * rise);
    return -2.0 * (half_slope(Interval(0.0)) / bend) - t;
  }
  /// For certain, for all reals in `t`: between the cone's ends; before or behind them.
  bool is_between_ends(const Interval& t) const {
    const Interval height = dot(at(t), axis);
    return height.low >= 0.0 && (axis_squared - height).low >= 0.0;
  }
  bool is_beyond_ends(const Interval& t) const {
    const Interval height = dot(at(t), axis);
    return height.high < 0.0 || (axis_squared - height).high < 0.0;
  }

  Reals direction, from_base, axis, across_rate;
  Interval radius, widening, axis_squared, rise;
};

/// An interval about `t` at whose ends f certainly has the signs `before` and -`before`; all reals if none is found.
template <class Curved>
Interval root_about(const Curved& curved, double t, int before) {
  constexpr int widenings = 24;
  double reach = curved.value(t).most() / std::max(curved.half_slope(t).least(), std::numeric_limits<double>::min()) +
                 0x1p-52 * std::fabs(t);
  reach = std::min(reach, std::fabs(t) * 0x1p-24);
  for (int i = 0; i < widenings; ++i, reach *= 2) {
    const Interval about(t - reach, t + reach);
    if (sign_of(curved.value(about.low)) == before && sign_of(curved.value(about.high)) == -before) {
      return about;
    }
  }
  return Interval::everything();
}

/// The certificate of a root that doubles found and that was rounded to float.
Certificate of_root(const Interval& t) {
  Certificate certificate;
  if (t.is_bounded()) {
    certificate.t = t;
    certificate.t_error = (unit_rounding * magnitude(t) + t.width() + denormal_unit).high;
  }
  return certificate;
}

Certificate certify_sphere(const Ray& ray, const float* rows, std::size_t stride, std::size_t lane) {
  const RealSphere sphere(ray, CurvedValues(PrimitiveKind::sphere, rows, stride, lane));
  const double t = sphere_distance(ray, rows, stride, lane);
  if (!(t > 0.0)) {
    return {};
  }
  const bool is_outside_visible = sphere.radius.low > 0.0;
  // If the outside is visible, the far root is the answer only if the ray starts inside.
  const int start_sign = sign_of(sphere.value(0.0));
  const bool is_near = is_outside_visible && start_sign > 0;
  if (is_outside_visible && start_sign == 0) {
    return {};
  }
  return of_root(root_about(sphere, t, is_near ? 1 : -1));
}

/// Whether the other root certainly does not count before `t`. A ray enters at one of two roots and leaves at the other.
bool is_first(const RealCone& cone, const Interval& t, bool gets_out, bool is_inside_visible_only) {
  const Interval other = cone.other_root(t);
  return other.low > t.high || other.high <= 0.0 || (gets_out && is_inside_visible_only) ||
         (other.is_bounded() && cone.is_beyond_ends(other));
}

Certificate certify_cone(const Ray& ray, const float* rows, std::size_t stride, std::size_t lane) {
  const CurvedValues values(PrimitiveKind::cone, rows, stride, lane);
  const RealCone cone(ray, values);
  const bool is_inside_visible_only = values.is_inside_visible_only();
  const double t = cone_distance(ray, rows, stride, lane);
  if (!(t > 0.0)) {
    return {};
  }
  const int way = sign_of(cone.half_slope(Interval(t)));
  const Interval root = way != 0 ? root_about(cone, t, -way) : Interval::everything();
  const bool counts = root.low > 0.0 && root.is_bounded() && cone.is_between_ends(root) && (way > 0 || !is_inside_visible_only);
  return counts && is_first(cone, root, way > 0, is_inside_visible_only) ? of_root(root) : Certificate{};
}

}  // namespace

Certificate certify(const Ray& ray, PrimitiveKind kind, const float* rows, std::size_t stride, std::size_t lane) {
  if (!has_usual_direction(ray)) {
    return {};
  }
  switch (kind) {
    case PrimitiveKind::triangle:
      return certify_triangle(ray, rows, stride, lane);
    case PrimitiveKind::sphere:
      return certify_sphere(ray, rows, stride, lane);
    case PrimitiveKind::cone:
    case PrimitiveKind::instance:  // not a primitive
      break;
  }
  return certify_cone(ray, rows, stride, lane);
}

}  // namespace dmpc::core
