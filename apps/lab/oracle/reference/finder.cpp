#include "apps/lab/oracle/reference/finder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>

#include "apps/oracle/embree.h"

namespace dmpc::apps {
namespace {

using core::Vec3d;

/// In sizes of the scene; float moves a ray that starts one size away by less than 1e-6.
constexpr double box_margin = 1e-5;

/// Relative to the scene's size and its distance from zero, along a ray: in double, hits of coplanar triangles are no farther
/// apart, even at grazing angles.
constexpr double level_reach = 1e-9;

using Vec3l = core::Vec3<long double>;

/// Relative to a coordinate: a double's error is 2^-53 of it, and each of a few rotations and translations adds as much.
constexpr long double corner_rounding = 0x1p-51L;

struct Leaf {
  explicit Leaf(const ReferenceBody& body)
      : corner{Vec3l(body.place[0]), Vec3l(body.place[1]), Vec3l(body.place[2])},
        area(cross(corner[1] - corner[0], corner[2] - corner[0])),
        normal(normalize(area)) {
    for (std::size_t k = 0; k < 3; ++k) {
      longest = std::max(longest, length(corner[(k + 1) % 3] - corner[k]));
      moved = std::max(moved, corner_rounding * dot_of_magnitudes(normal, corner[k]));
    }
  }

  long double height() const { return length(area) / longest; }

  std::array<Vec3l, 3> corner;
  Vec3l area, normal;
  long double longest = 0;
  long double moved = 0;  ///< how far rounding moves a corner perpendicularly to the plane
};

/// Returns whether both are triangles of one plane: the corners of the smaller one lie in the plane of the other, within the
/// rounding of coordinates to double (2^-51 of each, as after a few rotations of a scene).
bool share_plane(const ReferenceScene& scene, std::uint32_t a, std::uint32_t b) {
  const ReferenceBody &first = scene.bodies[a], &second = scene.bodies[b];
  if (first.kind != core::PrimitiveKind::triangle || second.kind != core::PrimitiveKind::triangle) {
    return false;
  }
  const Leaf one(first), other(second);
  const Leaf& large = one.height() >= other.height() ? one : other;
  const Leaf& small = one.height() >= other.height() ? other : one;
  return std::all_of(small.corner.begin(), small.corner.end(), [&](const Vec3l& corner) {
    const Vec3l off = corner - large.corner[0];
    const long double moved = corner_rounding * dot_of_magnitudes(large.normal, corner);
    return std::fabs(dot(off, large.normal)) <= moved + large.moved * (1 + length(off) / large.height());
  });
}

/// Data of the current query for callbacks. Embree returns the address of `context`, the first member.
struct Query {
  embree::Context context;
  const ReferenceRay* ray = nullptr;
  ReferenceHit best;
  std::array<ReferenceHit, 32> level{};  ///< hits so close together that they may lie in one plane
  std::size_t level_count = 0;
};
static_assert(std::is_standard_layout_v<Query>);

Query& query_of(embree::Context* context) { return *reinterpret_cast<Query*>(context); }

}  // namespace

struct ReferenceFinder::Parts {
  const ReferenceScene* scene = nullptr;
  Vec3d middle;
  double unit = 1, margin = box_margin;  ///< Embree's unit in world units; `margin` in Embree's
  const embree::Library& library = embree::library();
  embree::OwnedScene boxes{RTC_SCENE_FLAG_ROBUST, RTC_BUILD_QUALITY_HIGH};

  void build();
  RTCRay embree_ray(const ReferenceRay& ray) const;
  /// Returns `t` in Embree's units, rounded up.
  float end_of(double t) const;
  /// Tests one body; returns whether its hit is the query's best so far, or level with that.
  bool test(unsigned body, Query& query) const;
  /// Returns whether it lies in the plane on which the ray starts, at its start.
  bool starts_on(unsigned body, double t, const ReferenceRay& ray) const;
  void note_level(const ReferenceHit& hit, Query& query) const;
  /// Returns the visible one of the hits that are level with the best in its plane.
  ReferenceHit shown(const Query& query) const;
  double reach() const { return level_reach * (scene->size + length(middle)); }

  static const Parts& of(const void* user_data) { return *static_cast<const Parts*>(user_data); }
  static void bounds_callback(const RTCBoundsFunctionArguments* arguments);
  static void intersect_callback(const RTCIntersectFunctionNArguments* arguments);
  static void occluded_callback(const RTCOccludedFunctionNArguments* arguments);
};

void ReferenceFinder::Parts::build() {
  RTCGeometry geometry = library.new_geometry(boxes.device(), RTC_GEOMETRY_TYPE_USER);
  library.set_geometry_user_primitive_count(geometry, static_cast<unsigned>(scene->bodies.size()));
  library.set_geometry_user_data(geometry, this);
  library.set_geometry_bounds_function(geometry, bounds_callback, nullptr);
  library.set_geometry_intersect_function(geometry, intersect_callback);
  library.set_geometry_occluded_function(geometry, occluded_callback);
  boxes.attach(geometry);
  boxes.build();
}

float ReferenceFinder::Parts::end_of(double t) const {
  return std::nextafter(static_cast<float>(t / unit), std::numeric_limits<float>::infinity());
}

RTCRay ReferenceFinder::Parts::embree_ray(const ReferenceRay& ray) const {
  const core::Vec3f origin((ray.origin - middle) * (1 / unit)), direction(ray.direction);
  RTCRay result{};
  result.org_x = origin.x, result.org_y = origin.y, result.org_z = origin.z;
  result.dir_x = direction.x, result.dir_y = direction.y, result.dir_z = direction.z;
  result.tfar = end_of(ray.t_max);
  result.mask = ~0U;
  return result;
}

bool ReferenceFinder::Parts::test(unsigned body, Query& query) const {
  const ReferenceBody& tested = scene->bodies[body];
  const bool starts_there = body == query.ray->ignored_body;
  const std::optional<double> t = starts_there ? distance_across(tested, *query.ray) : distance_to(tested, *query.ray);
  ReferenceHit& best = query.best;
  if (!t || *t > best.t + reach() || starts_on(body, *t, *query.ray)) {
    return false;
  }
  if (*t < best.t || (*t == best.t && body < best.body)) {
    best = {*t, body};
  }
  note_level({*t, body}, query);
  return true;
}

bool ReferenceFinder::Parts::starts_on(unsigned body, double t, const ReferenceRay& ray) const {
  return t < reach() && ray.ignored_body != core::no_primitive && share_plane(*scene, ray.ignored_body, body);
}

void ReferenceFinder::Parts::note_level(const ReferenceHit& hit, Query& query) const {
  if (query.level_count == query.level.size()) {
    const auto end = std::remove_if(query.level.begin(), query.level.end(),
                                    [&](const ReferenceHit& other) { return other.t > query.best.t + reach(); });
    query.level_count = static_cast<std::size_t>(end - query.level.begin());
  }
  if (query.level_count < query.level.size()) {
    query.level[query.level_count++] = hit;
  }
}

ReferenceHit ReferenceFinder::Parts::shown(const Query& query) const {
  ReferenceHit shown = query.best;
  const auto rank = [&](std::uint32_t body) { return scene->materials[scene->bodies[body].material].rank_in_plane(); };
  for (std::size_t i = 0; i < query.level_count; ++i) {
    const std::uint32_t body = query.level[i].body;
    if (scene->bodies[body].object == scene->bodies[query.best.body].object) {
      continue;  // a polygon's triangles lie side by side
    }
    const bool comes_before = std::pair(rank(body), body) < std::pair(rank(shown.body), shown.body);
    if (comes_before && query.level[i].t <= query.best.t + reach() && share_plane(*scene, query.best.body, body)) {
      shown.body = body;
    }
  }
  return shown;
}

void ReferenceFinder::Parts::bounds_callback(const RTCBoundsFunctionArguments* arguments) {
  const Parts& parts = of(arguments->geometryUserPtr);
  const core::Box box = bounds_of(parts.scene->bodies[arguments->primID]);
  const Vec3d margin{parts.margin, parts.margin, parts.margin};
  const core::Vec3f low((box.low - parts.middle) * (1 / parts.unit) - margin);
  const core::Vec3f high((box.high - parts.middle) * (1 / parts.unit) + margin);
  RTCBounds& bounds = *arguments->bounds_o;
  bounds.lower_x = low.x, bounds.lower_y = low.y, bounds.lower_z = low.z;
  bounds.upper_x = high.x, bounds.upper_y = high.y, bounds.upper_z = high.z;
}

void ReferenceFinder::Parts::intersect_callback(const RTCIntersectFunctionNArguments* arguments) {
  Query& query = query_of(arguments->context);
  const Parts& parts = of(arguments->geometryUserPtr);
  if (arguments->valid[0] == 0 || !parts.test(arguments->primID, query)) {
    return;
  }
  RTCRayN_tfar(RTCRayHitN_RayN(arguments->rayhit, arguments->N), arguments->N, 0) = parts.end_of(query.best.t + parts.reach());
  RTCHitN* hit = RTCRayHitN_HitN(arguments->rayhit, arguments->N);
  RTCHitN_primID(hit, arguments->N, 0) = arguments->primID;
  RTCHitN_geomID(hit, arguments->N, 0) = arguments->geomID;
}

void ReferenceFinder::Parts::occluded_callback(const RTCOccludedFunctionNArguments* arguments) {
  if (arguments->valid[0] != 0 && of(arguments->geometryUserPtr).test(arguments->primID, query_of(arguments->context))) {
    RTCRayN_tfar(arguments->ray, arguments->N, 0) = -std::numeric_limits<float>::infinity();
  }
}

ReferenceFinder::ReferenceFinder(const ReferenceScene& scene, const core::Vec3d& eye) : parts_(std::make_unique<Parts>()) {
  parts_->scene = &scene;
  parts_->unit = scene.size;
  if (!scene.bounds.empty()) {
    parts_->middle = scene.bounds.center();
    parts_->margin = box_margin * std::max(1.0, length(eye - parts_->middle) / scene.size);
  }
  parts_->build();
}

ReferenceFinder::~ReferenceFinder() = default;

ReferenceHit ReferenceFinder::closest(const ReferenceRay& ray) const {
  Query query{.context = {}, .ray = &ray, .best = {}};
  embree::start(query.context);
  RTCRayHit ray_hit{};
  ray_hit.ray = parts_->embree_ray(ray);
  ray_hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  embree::intersect(parts_->library, parts_->boxes.scene(), query.context, ray_hit);
  return query.level_count > 1 ? parts_->shown(query) : query.best;
}

ReferenceHit ReferenceFinder::any(const ReferenceRay& ray) const {
  Query query{.context = {}, .ray = &ray, .best = {}};
  embree::start(query.context);
  RTCRay asked = parts_->embree_ray(ray);
  embree::occlude(parts_->library, parts_->boxes.scene(), query.context, asked);
  return query.best;
}

}  // namespace dmpc::apps
