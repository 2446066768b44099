#include "apps/oracle/oracle.h"

#include <cstring>
#include <optional>

#include "apps/oracle/curved.h"
#include "apps/oracle/embree.h"
#include "core/record/instance.h"
#include "core/trace/placed_leaf.h"
#include "core/trace/primitive.h"

namespace dmpc::apps {
namespace {

/// What the callbacks know of the query under way. Embree hands back the address of `context`, the first member.
struct Query {
  embree::Context context;
  const core::Ray* ray = nullptr;
  core::Hit best;
};
static_assert(std::is_standard_layout_v<Query>);

Query& query_of(embree::Context* context) { return *reinterpret_cast<Query*>(context); }

/// Whether primitive `id` at distance `t` is the query's best so far; if so it is noted.
bool improves(Query& query, float t, std::uint32_t id) {
  if (!(t > 0) || !(t < query.ray->t_max) || !nearer(t, id, query.best)) {
    return false;
  }
  query.best.t = t;
  query.best.primitive = id;
  return true;
}

const std::uint32_t* ids_of(void* user_data) { return static_cast<const std::uint32_t*>(user_data); }

/// Called for each triangle that Embree found at or before the ray's present end, ties included. Also serves as the filter of
/// occlusion queries, where the first acceptance ends the traversal.
void filter_triangle(const RTCFilterFunctionNArguments* arguments) {
  const float t = RTCRayN_tfar(arguments->ray, arguments->N, 0);
  const std::uint32_t id = ids_of(arguments->geometryUserPtr)[RTCHitN_primID(arguments->hit, arguments->N, 0)];
  Query& query = query_of(arguments->context);
  if (id == query.ray->ignored_primitive || !improves(query, t, id)) {
    arguments->valid[0] = 0;
  }
}

/// In double precision, if it is the query's best so far.
std::optional<float> improving_distance(const embree::CurvedQuery& asked) {
  Query& query = query_of(asked.context);
  const std::optional<double> t = nearest_on_curved(asked.shapes.primitives[asked.id], *query.ray);
  return t && improves(query, static_cast<float>(*t), asked.id) ? std::optional(query.best.t) : std::nullopt;
}

}  // namespace

struct EmbreeScene::Parts {
  const embree::Library& library = embree::library();
  embree::Shapes shapes;
  embree::OwnedScene tree;

  Parts(std::span<const core::PrimitiveValues> primitives, EmbreeMode mode)
      : shapes(primitives),
        tree(mode == EmbreeMode::robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE, RTC_BUILD_QUALITY_HIGH) {}
  RTCGeometry triangles();
};

namespace {

Query start_query(const core::Ray& ray) {
  Query query;
  embree::start(query.context);
  query.ray = &ray;
  return query;
}

bool can_hit(const core::Ray& ray) { return is_finite(ray.origin) && is_finite(ray.direction) && ray.t_max > 0; }

}  // namespace

RTCGeometry EmbreeScene::Parts::triangles() {
  RTCGeometry geometry = embree::triangle_mesh(tree.device(), shapes);
  library.set_geometry_user_data(geometry, shapes.triangles.data());
  library.set_geometry_intersect_filter_function(geometry, filter_triangle);
  library.set_geometry_occluded_filter_function(geometry, filter_triangle);
  return geometry;
}

EmbreeScene::EmbreeScene(std::span<const core::PrimitiveValues> primitives, EmbreeMode mode)
    : parts_(std::make_unique<Parts>(primitives, mode)) {
  const embree::Shapes& shapes = parts_->shapes;
  if (!shapes.triangles.empty()) {
    parts_->tree.attach(parts_->triangles());
  }
  if (!shapes.curved.empty()) {
    parts_->tree.attach(embree::curved_geometry<improving_distance>(parts_->tree.device(), shapes));
  }
  parts_->tree.build();
}

EmbreeScene::~EmbreeScene() = default;

core::Hit EmbreeScene::closest(const core::Ray& ray) const {
  Query query = start_query(ray);
  if (can_hit(ray)) {
    RTCRayHit ray_hit{};
    ray_hit.ray = embree::ray_of(ray);
    ray_hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    embree::intersect(parts_->library, parts_->tree.scene(), query.context, ray_hit);
  }
  return query.best;
}

bool EmbreeScene::occluded(const core::Ray& ray) const {
  if (!can_hit(ray)) {
    return false;
  }
  Query query = start_query(ray);
  RTCRay asked = embree::ray_of(ray);
  embree::occlude(parts_->library, parts_->tree.scene(), query.context, asked);
  return query.best.found();
}

namespace {

/// t of lane `lane` of the leaf at `record` by our own kernels.
float distance_in(const core::Ray& ray, const std::byte* record, std::uint32_t lane) {
  core::LeafHeader header;
  std::memcpy(&header, record, sizeof(header));
  const auto* rows = reinterpret_cast<const float*>(record + sizeof(header));
  const auto shared_distance = [&] {
    float times[core::leaf_lanes] = {};
    core::hit_shared_faces(core::ShearedRay(ray), record, core::no_primitive, ray.t_max, times);
    return times[lane];
  };
  return (header.shared_lanes >> lane & 1U) != 0 ? shared_distance()
         : header.kind == core::PrimitiveKind::triangle
             ? core::intersect_triangle(core::ShearedRay(ray), rows, header.count, lane)
         : header.kind == core::PrimitiveKind::sphere ? core::intersect_sphere(ray, rows, header.count, lane)
                                                      : core::intersect_cone(ray, rows, header.count, lane);
}

}  // namespace

/// By our own kernels, so that its bits do not depend on who named the primitive. Where they deny the hit (the ray brushes the
/// silhouette), Embree's t stays.
float EmbreeTracer::own_distance(const core::Ray& ray, const core::Hit& hit) const {
  const std::byte* record = find(hit.leaf);
  core::PlacedLeaf placed;
  if (is_in_instance(hit)) {
    placed.place(record, core::PlacedMesh(core::read<core::InstanceRecord>(find(instance_of(hit))), *frame_));
    record = placed.record();
  }
  const float t = distance_in(ray, record, hit.lane & core::lane_mask);
  return t > 0 && t < ray.t_max ? t : hit.t;
}

core::Traced EmbreeTracer::trace(const core::Ray& ray, core::Cursor& cursor, core::Operations&) {
  cursor.best = {};
  cursor.stage = core::Cursor::Stage::finished;
  if (ray.kind == core::RayKind::shadow) {
    return scene_->occluded(ray) ? core::Traced::hit : core::Traced::miss;
  }
  core::Hit& best = cursor.best = scene_->closest(ray);
  if (!best.found()) {
    return core::Traced::miss;
  }
  const core::Database::Place place = places_[best.primitive];
  best.leaf = place.leaf;
  best.lane = place.lane;
  best.t = own_distance(ray, best);
  return core::Traced::hit;
}

void open_embree() { static_cast<void>(embree::library()); }

const char* embree_version() { return RTC_VERSION_STRING; }

}  // namespace dmpc::apps
