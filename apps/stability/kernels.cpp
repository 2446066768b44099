#include "apps/stability/kernels.h"

#include <cmath>

#include "apps/stability/rays.h"
#include "apps/stability/records.h"
#include "apps/stability/walk.h"
#include "core/traversal.h"

namespace dmpc::apps {
namespace {

constexpr std::array<std::string_view, stability_kernel_count> names{
    "grid",        "grid, scalar",  "grid, no skipping", "grid, resumed", "grid, any hit",
    "Embree fast", "Embree robust", "grid, regions",     "grid, planes",  "grid, listing"};

core::Ray of_kind(core::Ray ray, core::RayKind kind) {
  ray.kind = kind;
  return ray;
}

void test_scalar(const core::Ray& ray, const core::ShearedRay& sheared, const BlockView& block, core::Hit& best) {
  if (block.kind != core::PrimitiveKind::triangle) {
    return;
  }
  for (std::size_t lane = 0; lane < block.count; ++lane) {
    const float t = core::intersect_triangle(sheared, block.rows, block.count, lane);
    if (t > 0.0F && t < ray.t_max && nearer(t, block.ids[lane], best) && block.ids[lane] != ray.ignored_primitive) {
      best.t = t;
      best.primitive = block.ids[lane];
    }
  }
}

core::Hit shoot_scalar(const core::Database& database, const core::Ray& ray) {
  const core::ShearedRay sheared(ray);
  return walk_blocks(database, ray, [&](const BlockView& block, core::Hit& best) { test_scalar(ray, sheared, block, best); });
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

std::string_view name_of(StabilityKernel kernel) { return names[index_of(kernel)]; }

bool embree_takes(const core::Ray& ray) {
  constexpr float most = 1e18F;
  bool takes = ray.t_max > 0.0F;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    takes = takes && std::fabs(ray.origin[axis]) < most && std::fabs(ray.direction[axis]) < most;
  }
  return takes;
}

StabilityAnswers ask_kernels(const StabilitySubject& subject, const core::Ray& ray) {
  const core::Ray nearest = of_kind(ray, core::RayKind::primary);
  const core::Database& database = subject.database;
  const bool takes = embree_takes(ray);
  return {shoot(database, nearest),
          shoot_scalar(database, nearest),
          shoot(database, nearest, false),
          shoot_resumed(database, nearest),
          shoot(database, of_kind(ray, core::RayKind::shadow)),
          takes ? subject.embree_fast.closest(nearest) : core::Hit{},
          takes ? subject.embree_robust.closest(nearest) : core::Hit{}};
}

}  // namespace dmpc::apps
