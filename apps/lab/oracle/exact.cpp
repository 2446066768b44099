#include "apps/lab/oracle/exact.h"

#include <gmpxx.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/record/curved_values.h"

namespace dmpc::apps {
namespace {

using core::Certificate;
using core::Ray;
using Fault = CertificateFault;

constexpr std::array<std::string_view, certificate_fault_count> fault_names{"no fault",
                                                                            "no exact answer",
                                                                            "distance outside its interval",
                                                                            "weights outside their intervals",
                                                                            "hit off by more than it allows",
                                                                            "edge passed by more than it allows"};

struct Exact {
  mpq_class x, y, z;

  Exact() = default;
  Exact(mpq_class of_x, mpq_class of_y, mpq_class of_z) : x(std::move(of_x)), y(std::move(of_y)), z(std::move(of_z)) {}
  explicit Exact(const core::Vec3d& v) : x(v.x), y(v.y), z(v.z) {}
  explicit Exact(const core::Vec3f& v) : Exact(core::Vec3d(v)) {}
};

Exact operator+(const Exact& a, const Exact& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Exact operator-(const Exact& a, const Exact& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
mpq_class dot(const Exact& a, const Exact& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Exact cross(const Exact& a, const Exact& b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }

Exact origin_of(const Ray& ray) { return Exact(ray.origin) + Exact(ray.origin_rest); }
Exact direction_of(const Ray& ray) { return Exact(ray.direction) + Exact(ray.direction_rest); }

bool holds(const core::Interval& interval, const mpq_class& x) { return !(interval.low > x) && !(interval.high < x); }

/// Solves by Cramer's rule.
struct ExactTriangle {
  ExactTriangle(const Ray& ray, const core::PrimitiveValues& values) {
    const auto vertex = [&](std::size_t k) {
      return Exact(core::Vec3f{values.value[3 * k], values.value[3 * k + 1], values.value[3 * k + 2]});
    };
    const std::array<Exact, 3> seen{vertex(0) - origin_of(ray), vertex(1) - origin_of(ray), vertex(2) - origin_of(ray)};
    for (std::size_t k = 0; k < 3; ++k) {
      edge[k] = dot(direction_of(ray), cross(seen[(k + 1) % 3], seen[(k + 2) % 3]));
    }
    const Exact v0 = vertex(0), edge1 = vertex(1) - v0, edge2 = vertex(2) - v0, normal = cross(edge1, edge2);
    const Exact from_v0 = origin_of(ray) - v0, direction = direction_of(ray), across = cross(from_v0, direction);
    const mpq_class approach = -dot(normal, direction);
    exists = approach != 0;
    if (exists) {
      t = dot(normal, from_v0) / approach;
      u = dot(edge2, across) / approach;
      v = -dot(edge1, across) / approach;
    }
  }

  /// Returns whether each edge function is on the side of `sign`, or no farther on the other side than allowed.
  bool is_within(const std::array<double, 3>& edge_error, int sign) const {
    const auto holds = [&](std::size_t k) { return !std::isfinite(edge_error[k]) || sign * edge[k] >= -edge_error[k]; };
    return holds(0) && holds(1) && holds(2);
  }

  bool exists = false;
  mpq_class t, u, v;
  std::array<mpq_class, 3> edge;  ///< edge functions, each of the edge opposite a vertex
};

Fault fault_of_triangle(const Ray& ray, const core::PrimitiveValues& values, float t, const Certificate& certificate) {
  const ExactTriangle exact(ray, values);
  if (!exact.exists) {
    return Fault::no_answer;
  }
  if (!holds(certificate.t, exact.t)) {
    return Fault::distance;
  }
  if (!holds(certificate.u, exact.u) || !holds(certificate.v, exact.v)) {
    return Fault::weights;
  }
  if (std::isfinite(certificate.t_error) && abs(exact.t - double{t}) > certificate.t_error) {
    return Fault::hit;
  }
  if (!exact.is_within(certificate.edge_error, 1) && !exact.is_within(certificate.edge_error, -1)) {
    return Fault::edge;
  }
  return Fault::none;
}

/// a t^2 + 2 b t + c, which is 0 on the sphere; a > 0.
struct ExactSphere {
  ExactSphere(const Ray& ray, const core::PrimitiveValues& values) {
    const core::CurvedValues sphere = values.curved();
    const Exact from_center = origin_of(ray) - Exact(sphere.vector(0)), direction = direction_of(ray);
    const mpq_class radius = sphere.value(3);
    a = dot(direction, direction);
    b = dot(from_center, direction);
    c = dot(from_center, from_center) - radius * radius;
    exists = b * b >= a * c;
    middle = -b / a;
    is_near = radius > 0 && c > 0 && middle > 0;
  }

  mpq_class at(const mpq_class& t) const { return (a * t + 2 * b) * t + c; }
  /// Returns whether the root that counts lies in [low, high]: the polynomial falls before the middle and rises behind it.
  bool has_answer_in(const mpq_class& low, const mpq_class& high) const {
    return is_near ? low <= middle && at(low) >= 0 && (high >= middle || at(high) <= 0)
                   : high >= middle && at(high) >= 0 && (low <= middle || at(low) <= 0);
  }

  mpq_class a, b, c, middle;
  bool exists = false, is_near = false;
};

Fault fault_of_sphere(const Ray& ray, const core::PrimitiveValues& values, float t, const Certificate& certificate) {
  const ExactSphere exact(ray, values);
  if (!exact.exists) {
    return Fault::no_answer;
  }
  if (!exact.has_answer_in(certificate.t.low, certificate.t.high)) {
    return Fault::distance;
  }
  const mpq_class hit = double{t}, error = certificate.t_error;
  return exact.has_answer_in(hit - error, hit + error) ? Fault::none : Fault::hit;
}

/// a t^2 + 2 b t + c, which is 0 on the unbounded cone, as in core/trace/certificate.cpp.
struct ExactCone {
  ExactCone(const Ray& ray, const core::PrimitiveValues& values) {
    const core::CurvedValues cone = values.curved();
    const Exact base(cone.vector(0)), from_base = origin_of(ray) - base;
    const Exact axis = cone.is_flat() ? Exact(cone.vector(4)) : Exact(cone.vector(4)) - base;
    const Exact direction = direction_of(ray), across = cross(from_base, axis), across_rate = cross(direction, axis);
    axis_squared = dot(axis, axis);
    height = dot(from_base, axis);
    height_rate = dot(direction, axis);
    const mpq_class radius = std::fabs(cone.value(3)), widening = std::fabs(cone.value(7)) - radius;
    const mpq_class wide = radius * axis_squared + widening * height, wide_rate = widening * height_rate;
    a = axis_squared * dot(across_rate, across_rate) - wide_rate * wide_rate;
    b = axis_squared * dot(across, across_rate) - wide * wide_rate;
    c = axis_squared * dot(across, across) - wide * wide;
    is_inside_visible_only = cone.is_inside_visible_only();
  }

  mpq_class at(const mpq_class& t) const { return (a * t + 2 * b) * t + c; }
  bool changes_sign(const mpq_class& low, const mpq_class& high) const { return sgn(at(low)) * sgn(at(high)) < 0; }
  /// Returns 0 between the ends and on them, else the side.
  int beyond(const mpq_class& t) const {
    const mpq_class there = height + height_rate * t;
    return there < 0 ? -1 : there > axis_squared ? 1 : 0;
  }
  /// Returns whether the only root between `low` and `high` counts: a bracket that narrows around it shows on which side of an
  /// end it is.
  bool counts(mpq_class low, mpq_class high) const {
    if (is_inside_visible_only && at(high) < 0) {
      return false;
    }
    constexpr int halvings = 200;
    for (int i = 0; i < halvings && beyond(low) != beyond(high); ++i) {
      const mpq_class middle = (low + high) / 2;
      if (at(middle) == 0) {
        return beyond(middle) == 0;
      }
      (changes_sign(low, middle) ? high : low) = middle;
    }
    return beyond(low) == 0 || beyond(high) == 0;
  }

  mpq_class a, b, c, axis_squared, height, height_rate;
  bool is_inside_visible_only = false;
};

Fault fault_of_cone(const Ray& ray, const core::PrimitiveValues& values, float t, const Certificate& certificate) {
  const ExactCone exact(ray, values);
  const mpq_class low = certificate.t.low, high = certificate.t.high, hit = double{t}, error = certificate.t_error;
  if (exact.b * exact.b < exact.a * exact.c) {
    return Fault::no_answer;
  }
  const bool is_earlier_one = low > 0 && exact.changes_sign(0, low) && exact.counts(0, low);
  if (low <= 0 || !exact.changes_sign(low, high) || !exact.counts(low, high) || is_earlier_one) {
    return Fault::distance;
  }
  return hit - error <= low && high <= hit + error ? Fault::none : Fault::hit;
}

double last_place(float t) { return double{std::nextafter(t, std::numeric_limits<float>::infinity())} - double{t}; }

}  // namespace

std::string_view name_of(CertificateFault fault) { return fault_names[static_cast<std::size_t>(fault)]; }

CertificateFault fault_of(const Ray& ray, const core::PrimitiveValues& values, float t, const Certificate& certificate) {
  if (!certificate.is_decided()) {
    return Fault::none;
  }
  switch (values.kind) {
    case core::PrimitiveKind::triangle:
      return fault_of_triangle(ray, values, t, certificate);
    case core::PrimitiveKind::sphere:
      return fault_of_sphere(ray, values, t, certificate);
    case core::PrimitiveKind::cone:
    case core::PrimitiveKind::instance:  // is no primitive
      break;
  }
  return fault_of_cone(ray, values, t, certificate);
}

CertifiedHit certified(const core::Ray& ray, const core::PrimitiveValues& values, float t) {
  if (values.needs_plane()) {
    return {};  // hit in the plane shared with others or given by doubles (core/database/faces/coplanar.h), not at its own
                // corners
  }
  const core::Certificate certificate = core::certify(ray, values.kind, values.value.data(), 1, 0);
  if (!certificate.is_decided()) {
    return {};
  }
  const double place = last_place(std::max(t, static_cast<float>(certificate.t.high))),
               off = std::max(double{t} - certificate.t.low, certificate.t.high - double{t});
  return {
      fault_of(ray, values, t, certificate), true,        values.kind != core::PrimitiveKind::triangle || certificate.is_inside(),
      certificate.t.width() / place,         off / place, certificate.t_error / place};
}

double Spread::median() const {
  if (values_.empty()) {
    return 0;
  }
  std::vector<double> values = values_;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double Spread::worst() const { return values_.empty() ? 0 : *std::max_element(values_.begin(), values_.end()); }

void CertifiedCounts::count(const CertifiedHit& hit) {
  ++hits;
  if (!hit.is_decided) {
    ++undecided;
    return;
  }
  ++faults[static_cast<std::size_t>(hit.fault)];
  width_ulp.add(hit.width_ulp);
  if (hit.is_inside) {
    ++inside;
    error_ulp.add(hit.error_ulp);
    allowed_ulp.add(hit.allowed_ulp);
  }
}

std::uint64_t CertifiedCounts::failures() const {
  return std::accumulate(faults.begin(), faults.end(), std::uint64_t{0}) -
         faults[static_cast<std::size_t>(CertificateFault::none)];
}

}  // namespace dmpc::apps
