// Where the bounds come from. u = 2^-24 is half a unit in the last place of 1 in float; bounds are to first order in u, with
// every constant rounded up. Let a, b, c be a triangle's vertices as seen from the ray's origin, D the ray's direction, and for
// each edge N = D . (a x b): twice the signed area that the edge and the ray span in projection along D, times |D|. The ray is
// inside where all three N have one sign. a' is the part of a across D.
//
// Grid (Woop). Subtraction of the origin costs u in each coordinate; the shear x - Sx z costs 2u |z| for Sx (a quotient and a
// product), u |z| inherited, and u |x - Sx z|, in all at most u (2 |x| + 4 |z|), so a vertex moves by less than 7 u |a| in the
// sheared plane. The plane is oblique by at most sqrt(3), which multiplies areas and lengths alike. Shared vertices move alike.
// The two products of the edge function cost u |a'| |b'| sqrt(3) more. Of vertices that lie nearer to the ray than they are moved
// the second order counts, too. Hence
//     |error of N| <= u |D| (7 (|a| |b'| + |b| |a'|) + 2 |a'| |b'| + 49 u |a| |b|).
// Embree robust (Pluecker coordinates). Vertices move by u |a|; edge e = a - b and sum s = a + b cost u each, their cross product
// 2u, the product with D 3u, each times |e| |s| |D|, for 2 N; it then accepts down to one ulp = 2u of the sum of all three. Hence
//     |error of N| <= u |D| (|a| |b'| + |b| |a'| + 3.5 |e| |s| + u |a| |b|) + 2 u |N1 + N2 + N3|.
// Distance. Moved vertices shift the plane by 7 u R, R the largest of |a|, |b|, |c|, which is 7 u R / cos along the ray; Embree's
// dot products cost as much. Rounded edge functions, or the rounded cross product of two edges, tilt the hit about the triangle:
// with E the longest edge at most 6 u E^3 |D| / |N1 + N2 + N3|. Sums and quotients cost a few u R. No renderer returns a t
// outside the triangle's own depths: Embree along the ray, ours along the direction's largest axis, where E takes at most sqrt(3)
// E of the ray. The t it is held against may be E off itself (below), so 3 E bounds what remains. Hence
//     |error of t| <= min(3 E, u (8 R / cos + 6 E^3 |D| / |N1 + N2 + N3|)) + 8 u R.
//
// A triangle in a plane that doubles tell is met where that is, seen along the floats of the direction: the slopes of a ray cost
// 4 u t / cos along it, products and quotients a few u t and v of the coordinates, and layers are up to 8 places of t apart.
//
// Spheres and cones are solved in double by both renderers and rounded to float once. Their quadratic A t^2 + 2 B t + C has
// coefficients that cost at most 16 v |D|^2, 16 v |D| S and 16 v S^2 with v = 2^-53, S the extent of ray origin and body about
// each other; where the roots are double, rounding moves them by the root of that.
#include "apps/lab/oracle/exact_intersection.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/record/curved_values.h"

namespace dmpc::apps {
namespace {

using core::Ray;
using core::Vec3d;
using core::Vec3f;
using Long = long double;
using Vec3l = core::Vec3<long double>;

constexpr double unit_rounding = 0x1p-24;
/// Half a unit in the last place of denormal floats, the least error of rounding to float.
constexpr double denormal_rounding = 0x1p-150;
constexpr Long double_rounding = 0x1p-53L;
constexpr double tiny = std::numeric_limits<double>::min();

/// A vertex as seen from the ray's origin.
struct Sight {
  Vec3d position;
  double distance, across;  ///< the vertex's distances from the origin and from the ray's line
};

Vec3f vertex(const core::PrimitiveValues& values, std::size_t index) {
  return {values.value[3 * index], values.value[3 * index + 1], values.value[3 * index + 2]};
}

/// D . (a x b) in precision T, from the floats themselves.
template <class T>
T spanned(const Ray& ray, const Vec3f& a, const Vec3f& b) {
  const core::Vec3<T> origin = core::Vec3<T>(ray.origin) + core::Vec3<T>(ray.origin_rest);
  return dot(core::Vec3<T>(ray.direction), cross(core::Vec3<T>(a) - origin, core::Vec3<T>(b) - origin));
}

struct Edge {
  double area;                  ///< N above
  std::array<double, 2> bound;  ///< bound of its error, by Renderer
};

struct SeenTriangle {
  std::array<Sight, 3> sight;
  std::array<Edge, 3> edge;
  double area, reach, longest, direction_length;
};

/// Returns N of the edge from a to b. In double its error is some 2^-50 |a| |b| |D|; a smaller result is computed again in long
/// double.
double signed_area(const Ray& ray, const Vec3f& a, const Vec3f& b, double scale) {
  const double area = spanned<double>(ray, a, b);
  return std::fabs(area) > 0x1p-48 * scale ? area : static_cast<double>(spanned<Long>(ray, a, b));
}

bool quickly_outside(const Ray& ray, const std::array<Vec3d, 3>& at) {
  const Vec3d d(ray.direction);
  const std::array<double, 3> area{dot(d, cross(at[0], at[1])), dot(d, cross(at[1], at[2])), dot(d, cross(at[2], at[0]))};
  const double reach = std::sqrt(std::max({dot(at[0], at[0]), dot(at[1], at[1]), dot(at[2], at[2])}));
  // This is more than any bound above: every length in them is at most 2 reach, and |D| is at most 2 for a ray of unit length.
  const double bound = (64 * unit_rounding * reach + 2 * length(Vec3d(ray.origin_rest))) * reach * (1 + dot(d, d));
  return std::min({area[0], area[1], area[2]}) < -bound && std::max({area[0], area[1], area[2]}) > bound;
}

Sight see(const Vec3d& at, const Vec3d& direction, double direction_length) {
  return {at, length(at), length(cross(at, direction)) / direction_length};
}

/// `rest` is the distance of the ray's start from the one given by its floats, which matters next to the start.
std::array<double, 2> area_bounds(const Sight& a, const Sight& b, double direction_length, double area_sum, double rest) {
  const double moved = a.distance * b.across + b.distance * a.across;
  const double rounded = length(a.position - b.position) * length(a.position + b.position);
  const double by_rest = direction_length * length(a.position - b.position) * rest;
  const double second_order = unit_rounding * a.distance * b.distance;
  return {unit_rounding * direction_length * (7 * moved + 2 * a.across * b.across + 49 * second_order) + by_rest + tiny,
          unit_rounding * (direction_length * (moved + 3.5 * rounded + second_order) + 2 * std::fabs(area_sum)) + tiny};
}

SeenTriangle see_triangle(const Ray& ray, const core::PrimitiveValues& values, const std::array<Vec3d, 3>& at) {
  const Vec3d d(ray.direction);
  SeenTriangle seen{};
  seen.direction_length = length(d);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    seen.sight[k] = see(at[k], d, seen.direction_length);
    seen.reach = std::max(seen.reach, seen.sight[k].distance);
    seen.longest = std::max(seen.longest, length(at[next] - at[k]));
    const double scale = length(at[k]) * length(at[next]) * seen.direction_length;
    seen.edge[k].area = signed_area(ray, vertex(values, k), vertex(values, next), scale);
    seen.area += seen.edge[k].area;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    seen.edge[k].bound =
        area_bounds(seen.sight[k], seen.sight[(k + 1) % 3], seen.direction_length, seen.area, length(Vec3d(ray.origin_rest)));
  }
  return seen;
}

/// Inside: the least edge, as all must agree. Outside: the lesser of the two that disagree most, as both must be beyond doubt.
double margin_of(const SeenTriangle& seen, Renderer renderer) {
  double least = std::numeric_limits<double>::infinity(), greatest = -least;
  for (const Edge& edge : seen.edge) {
    const double relative = edge.area / edge.bound[static_cast<std::size_t>(renderer)];
    least = std::min(least, relative);
    greatest = std::max(greatest, relative);
  }
  const double inside = std::max(least, -greatest);
  return inside >= 0 ? inside : -std::min(greatest, -least);
}

/// Edges are those of a ray that starts as its floats say; next to the start the grid's t is that of the full start.
double distance_error(const Ray& ray, const SeenTriangle& seen, double cosine) {
  const double area = std::fabs(seen.area) + tiny;
  const double tilt = 6 * seen.longest * seen.longest * seen.longest * seen.direction_length / area;
  const double moved =
      unit_rounding * (8 * seen.reach / (cosine + tiny) + tilt) + length(Vec3d(ray.origin_rest)) / (cosine + tiny);
  return (std::min(3 * seen.longest, moved) + 8 * unit_rounding * seen.reach) / seen.direction_length;
}

/// Returns t of the vertices' projections onto the ray.
std::array<double, 3> depths_of(const Ray& ray, const std::array<Vec3d, 3>& at) {
  const Vec3d d(ray.direction);
  const double squared = dot(d, d);
  return {dot(at[0], d) / squared, dot(at[1], d) / squared, dot(at[2], d) / squared};
}

/// Moves the hit to the plane in which the triangle lies, with the error of either renderer there.
void move_to_plane(const Ray& ray, const std::array<Vec3d, 3>& at, const core::FacePlane& plane,
                   ExactIntersection& exact_intersection) {
  constexpr double beside_box = 0x1p-21;
  const Vec3d direction(ray.direction), origin = ray.full_origin();
  const double across = dot(direction, plane.normal), height = plane.height_of(origin);
  const std::array<double, 3> depth = depths_of(ray, at);
  const auto [least, greatest] = std::minmax_element(depth.begin(), depth.end());
  if (across == 0) {
    return;
  }
  exact_intersection.t = std::clamp(-height / across, *least - beside_box, *greatest + beside_box);
  const double cosine = std::fabs(across), size = dot_of_magnitudes(plane.normal, origin) + std::fabs(plane.offset);
  exact_intersection.t_error = unit_rounding * std::fabs(exact_intersection.t) * (16 + 4 / cosine) + 16 * 0x1p-53 * size / cosine;
}

ExactIntersection meet_triangle(const Ray& ray, const core::PrimitiveValues& values, const std::array<Vec3d, 3>& at,
                                const core::FacePlane* exact) {
  const SeenTriangle seen = see_triangle(ray, values, at);
  const Vec3d normal = cross(at[1] - at[0], at[2] - at[0]);
  const double normal_length = length(normal), across = dot(Vec3d(ray.direction), normal);
  ExactIntersection exact_intersection;
  exact_intersection.margin = {margin_of(seen, Renderer::grid), margin_of(seen, Renderer::embree)};
  // A ray in the triangle's plane has no single distance, and one that almost lies in it may cross the plane far away: no
  // renderer returns a t beyond the vertices.
  const std::array<double, 3> depth = depths_of(ray, at);
  const auto [least, greatest] = std::minmax_element(depth.begin(), depth.end());
  exact_intersection.t = across != 0 ? std::clamp(dot(at[0], normal) / across, *least, *greatest) : *least;
  exact_intersection.t_error = distance_error(ray, seen, std::fabs(across) / (normal_length * seen.direction_length + tiny));
  exact_intersection.exact = exact_intersection.margin[0] >= 0 && seen.area != 0;
  if (exact != nullptr) {
    move_to_plane(ray, at, *exact, exact_intersection);
  }
  return exact_intersection;
}

/// A t^2 + 2 B t + C and its error bounds in double precision.
struct Quadratic {
  Long a, b, c;
  Long direction, size;  ///< |D| and S above

  Long discriminant() const { return b * b - a * c; }
  Long discriminant_error() const {
    const Long unit = 16 * double_rounding;
    return unit * (2 * std::fabs(b) * direction * size + std::fabs(a) * size * size + std::fabs(c) * direction * direction);
  }
  /// Returns the error of a root near t; 2 (a t + b) is the slope there.
  Long root_error(Long t) const {
    const Long residual = 16 * double_rounding * (direction * std::fabs(t) + size) * (direction * std::fabs(t) + size);
    const Long slope = 2 * std::fabs(a * t + b);
    const Long by_slope = slope > 0 ? residual / slope : std::numeric_limits<Long>::infinity();
    const Long by_bend = a != 0 ? std::sqrt(residual / std::fabs(a)) : std::numeric_limits<Long>::infinity();
    return std::min(by_slope, by_bend);
  }
  /// Returns 0, 1 or 2 roots. A discriminant that is negative within its error counts as 0: one double root.
  std::size_t roots(std::array<Long, 2>& root) const;
};

std::size_t Quadratic::roots(std::array<Long, 2>& root) const {
  if (!(discriminant() > -discriminant_error())) {
    return 0;
  }
  const Long q = -(b + std::copysign(std::sqrt(std::max(discriminant(), 0.0L)), b));
  std::size_t count = 0;
  if (a != 0) {
    root[count++] = q / a;
  }
  if (q != 0) {
    root[count++] = c / q;
  }
  if (count == 2 && root[0] > root[1]) {
    std::swap(root[0], root[1]);
  }
  return count;
}

/// A body of revolution about an axis; a sphere has no axis, and its surface has no ends.
struct Curved {
  Quadratic quadratic;
  Vec3l from_center, direction, axis;  ///< axis: of unit length, zero for a sphere
  Long base_radius = 0, slope = 0, height = 0;
  bool inside_only = false;

  /// Returns the distance from the nearer of the two ends, positive between them; infinite for a sphere.
  Long from_end(Long t) const {
    if (height == 0) {
      return std::numeric_limits<Long>::infinity();
    }
    const Long along = dot(from_center + direction * t, axis);
    return std::min(along, height - along);
  }
  /// Returns how squarely the ray leaves the body at t: D . outward normal, not normalised.
  Long leaving(Long t) const {
    const Vec3l point = from_center + direction * t;
    const Long along = dot(point, axis);
    return dot(direction, point - axis * (along + slope * (base_radius + slope * along)));
  }
};

/// Returns the sums of the two floats of each coordinate.
Vec3l full_origin(const Ray& ray) { return Vec3l(ray.origin) + Vec3l(ray.origin_rest); }
Vec3l full_direction(const Ray& ray) { return Vec3l(ray.direction) + Vec3l(ray.direction_rest); }

Curved see_sphere(const Ray& ray, const core::PrimitiveValues& values) {
  Curved curved;
  curved.direction = full_direction(ray);
  curved.from_center = full_origin(ray) - Vec3l(values.curved().vector(0));
  const Long radius = Long{values.curved().value(3)}, direction = length(curved.direction), distance = length(curved.from_center);
  curved.quadratic = {direction * direction, dot(curved.from_center, curved.direction), distance * distance - radius * radius,
                      direction, distance + std::fabs(radius)};
  curved.inside_only = radius < 0;
  return curved;
}

Curved see_cone(const Ray& ray, const core::PrimitiveValues& values) {
  Curved curved;
  const core::CurvedValues cone = values.curved();
  const Vec3l base(cone.vector(0)), to_apex = cone.is_flat() ? Vec3l(cone.vector(4)) : Vec3l(cone.vector(4)) - base;
  const Long apex_radius = std::fabs(Long{cone.value(7)});
  curved.direction = full_direction(ray);
  curved.from_center = full_origin(ray) - base;
  curved.height = length(to_apex);
  curved.axis = to_apex * (1 / curved.height);
  curved.base_radius = std::fabs(Long{cone.value(3)});
  curved.slope = (apex_radius - curved.base_radius) / curved.height;
  curved.inside_only = cone.is_inside_visible_only();
  const Long along = dot(curved.from_center, curved.axis), along_rate = dot(curved.direction, curved.axis);
  const Vec3l across = curved.from_center - curved.axis * along, across_rate = curved.direction - curved.axis * along_rate;
  const Long radius = curved.base_radius + curved.slope * along, radius_rate = curved.slope * along_rate;
  // The slope multiplies heights and their errors alike, so it belongs to the scale of both.
  const Long steep = 1 + std::fabs(curved.slope);
  curved.quadratic = {dot(across_rate, across_rate) - radius_rate * radius_rate, dot(across, across_rate) - radius * radius_rate,
                      dot(across, across) - radius * radius, steep * length(curved.direction),
                      steep * (length(curved.from_center) + curved.base_radius + apex_radius)};
  return curved;
}

Curved see_curved(const Ray& ray, const core::PrimitiveValues& values) {
  return values.kind == core::PrimitiveKind::sphere ? see_sphere(ray, values) : see_cone(ray, values);
}

ExactIntersection meet_curved(const Curved& curved, Long t) {
  const Quadratic& quadratic = curved.quadratic;
  const Long error = quadratic.root_error(t);
  const Long tangent = quadratic.discriminant() / quadratic.discriminant_error();
  const Long end_error = 16 * double_rounding * (quadratic.size + quadratic.direction * std::fabs(t)) +
                         std::fabs(dot(curved.direction, curved.axis)) * error;
  Long margin = std::min(tangent, curved.from_end(t) / end_error);
  if (curved.inside_only) {
    margin = std::min(margin, curved.leaving(t) / (end_error * quadratic.direction));
  }
  ExactIntersection exact_intersection;
  exact_intersection.t = static_cast<double>(t);
  exact_intersection.t_error = static_cast<double>(error + static_cast<Long>(unit_rounding) * std::fabs(t)) + denormal_rounding;
  exact_intersection.margin.fill(static_cast<double>(margin));
  exact_intersection.exact = margin >= 0;
  return exact_intersection;
}

/// Returns whether `t` is the start of an eye that, within rounding, lies on the body: there the eye sees nothing of it.
bool is_of_eye_on(const Ray& ray, const Curved& curved, Long t) {
  const Quadratic& quadratic = curved.quadratic;
  constexpr Long moved = 0x1p-30L;
  const Long place = core::largest_component(ray.full_origin());  // the eye's distance from centre or axis is the radius
  const Long other = quadratic.a != 0 ? -2 * quadratic.b / quadratic.a - t : t;
  return ray.kind == core::RayKind::primary && std::fabs(quadratic.c) <= moved * (place + quadratic.size) * quadratic.size &&
         std::fabs(t) <= std::fabs(other);
}

/// As above, for a curve on which `ray` may start.
ExactIntersection meet_curved(const Ray& ray, const Curved& curved, Long t) {
  ExactIntersection exact_intersection = meet_curved(curved, t);
  if (is_of_eye_on(ray, curved, t)) {
    exact_intersection.t_error = std::max(exact_intersection.t_error, std::fabs(exact_intersection.t));
  }
  return exact_intersection;
}

/// Sets what depends on the ray's ends; returns whether the exact intersection can count at all.
bool within_ends(const Ray& ray, std::uint32_t primitive, ExactIntersection& exact_intersection) {
  const double t_max = static_cast<double>(ray.t_max);
  exact_intersection.primitive = primitive;
  exact_intersection.exact = exact_intersection.exact && exact_intersection.t > 0 && exact_intersection.t < t_max;
  exact_intersection.at_end =
      exact_intersection.t <= exact_intersection.t_error || exact_intersection.t >= t_max - exact_intersection.t_error;
  return exact_intersection.t > -exact_intersection.t_error && exact_intersection.t < t_max + exact_intersection.t_error;
}

std::array<Vec3d, 3> seen_from(const Ray& ray, const core::PrimitiveValues& values) {
  const Vec3d origin = ray.full_origin();
  return {Vec3d(vertex(values, 0)) - origin, Vec3d(vertex(values, 1)) - origin, Vec3d(vertex(values, 2)) - origin};
}

bool possible(const ExactIntersection& exact_intersection) {
  return exact_intersection.possible(Renderer::grid) || exact_intersection.possible(Renderer::embree);
}

}  // namespace

void add_exact_intersections(const Ray& ray, const core::PrimitiveValues& values, std::uint32_t primitive,
                             std::vector<ExactIntersection>& exact_intersections, const core::FacePlane* exact) {
  const auto add = [&](ExactIntersection exact_intersection) {
    if (within_ends(ray, primitive, exact_intersection) && possible(exact_intersection)) {
      exact_intersections.push_back(exact_intersection);
    }
  };
  if (values.kind == core::PrimitiveKind::triangle) {
    const std::array<Vec3d, 3> at = seen_from(ray, values);
    if (!quickly_outside(ray, at)) {
      add(meet_triangle(ray, values, at, exact));
    }
    return;
  }
  const Curved curved = see_curved(ray, values);
  std::array<Long, 2> root{};
  const std::size_t count = curved.quadratic.roots(root);
  for (std::size_t k = 0; k < count; ++k) {
    add(meet_curved(ray, curved, root[k]));
  }
}

ExactIntersection examine(const Ray& ray, const core::PrimitiveValues& values, std::uint32_t primitive,
                          const core::FacePlane* exact) {
  if (values.kind == core::PrimitiveKind::triangle) {
    ExactIntersection exact_intersection = meet_triangle(ray, values, seen_from(ray, values), exact);
    within_ends(ray, primitive, exact_intersection);
    return exact_intersection;
  }
  const Curved curved = see_curved(ray, values);
  std::array<Long, 2> root{};
  ExactIntersection best;
  best.primitive = primitive;
  best.margin.fill(-std::numeric_limits<double>::infinity());
  const std::size_t count = curved.quadratic.roots(root);
  for (std::size_t k = 0; k < count; ++k) {
    ExactIntersection exact_intersection = meet_curved(ray, curved, root[k]);
    const bool counts = within_ends(ray, primitive, exact_intersection);
    if (exact_intersection.margin[0] > best.margin[0] && (counts || best.margin[0] < 0)) {
      best = exact_intersection;
    }
  }
  return best;
}

}  // namespace dmpc::apps
