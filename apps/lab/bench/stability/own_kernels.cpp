#include "apps/lab/bench/stability/own_kernels.h"

#include <bit>
#include <cstdint>

#include "apps/lab/bench/stability/rays.h"
#include "apps/lab/bench/stability/walk.h"
#include "core/trace/bundle_traversal.h"
#include "core/trace/traversal.h"

namespace dmpc::apps {
namespace {

void test_scalar(const core::Ray& ray, const core::ShearedRay& sheared, const LeafView& leaf, core::Hit& best) {
  float times[core::leaf_lanes] = {};
  core::hit_shared_faces(sheared, leaf.record, core::no_primitive, ray.t_max, times);
  for (std::size_t lane = 0; lane < leaf.count; ++lane) {
    const bool is_shared = (leaf.shared_lanes >> lane & 1U) != 0;
    const float t = is_shared ? times[lane] : core::intersect_triangle(sheared, leaf.rows, leaf.count, lane);
    if (t > 0.0F && t < ray.t_max && nearer(t, leaf.ids[lane], best) && leaf.ids[lane] != ray.ignored_primitive) {
      best.t = t;
      best.primitive = leaf.ids[lane];
    }
  }
}

core::Hit shoot_scalar(const core::Database& database, const core::Ray& ray) {
  const core::ShearedRay sheared(ray);
  return walk_leaves(database, ray, core::meet_children_scalar,
                     [&](const LeafView& leaf, core::Hit& best) { test_scalar(ray, sheared, leaf, best); });
}

core::Hit shoot_resumed(const core::Database& database, const core::Ray& ray) {
  OneRecord records(database.bytes());
  core::Cursor cursor;
  core::Operations operations;
  while (core::trace(ray, cursor, records, database.header(), {}, operations) == core::Traced::absent) {
    records.fetch(cursor.absent);
  }
  return cursor.best;
}

}  // namespace

core::Hit shoot_in_bundle(const core::Database& database, const core::Ray& ray) {
  core::LocalRecords records(database.bytes());
  core::Operations operations;
  core::RayBundle bundle;
  bundle.count = 4;
  bundle.rays.fill(ray);
  const bool is_apart = (std::bit_cast<std::uint32_t>(ray.direction.x) & 1U) != 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    core::Ray& neighbour = bundle.rays[axis < 2 ? axis : 3];
    neighbour.direction[axis] *= is_apart ? -1.0F : 1.001F;
  }
  bundle.start();
  core::trace(bundle, records, database.header(), {}, operations);
  return bundle.best.of(2);
}

OwnAnswers ask_own_kernels(const core::Database& database, const core::Ray& ray) {
  const core::Ray nearest = of_kind(ray, core::RayKind::reflected);
  return {
      shoot(database, nearest),         shoot_scalar(database, nearest),    shoot(CellByCell(database), database, nearest),
      shoot_resumed(database, nearest), shoot_in_bundle(database, nearest), shoot(database, of_kind(ray, core::RayKind::shadow))};
}

}  // namespace dmpc::apps
