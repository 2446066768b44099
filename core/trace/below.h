// The part of a ray's traversal that another node does: everything below a child whose record is absent.
#pragma once

#include <cstdint>
#include <type_traits>

#include "core/base/expect.h"
#include "core/record/hit.h"
#include "core/record/ray.h"
#include "core/record/record.h"
#include "core/record/records.h"
#include "core/trace/cursor.h"
#include "core/trace/traversal.h"

namespace dmpc::core {

/// Everything that decides what a traversal finds below `child` and what it counts: the ray and the bounds, with the bits that
/// the traversal itself would use.
struct Below {
  Vec3f origin, origin_rest, direction, direction_rest;  ///< as a Ray has them
  float t_max = 0;
  std::uint32_t ignored_primitive = no_primitive;
  BvhChild child = BvhChild::none();
  float t_low = 0, t_high = 0;                  ///< the macro cell's
  float best_t = 0;                             ///< t of the nearest hit so far
  std::uint32_t best_primitive = no_primitive;  ///< no_primitive: no hit so far
  std::uint32_t any = 0;                        ///< 1: any hit will do
};
static_assert(sizeof(Below) == 80 && std::is_trivially_copyable_v<Below>);

/// Whether any hit ends the ray's traversal.
inline bool ends_at_any_hit(const Ray& ray, const Skips& skips) { return skips.any_hit && ray.kind == RayKind::shadow; }

/// The rest of a traversal for which trace() has returned Traced::absent at `child`.
inline Below below(const Ray& ray, const Cursor& cursor, BvhChild child, const Skips& skips) {
  expect(cursor.stage == Cursor::Stage::child && child.found(), "a traversal that waits for a child is below the directory");
  return {.origin = ray.origin,
          .origin_rest = ray.origin_rest,
          .direction = ray.direction,
          .direction_rest = ray.direction_rest,
          .t_max = ray.t_max,
          .ignored_primitive = ray.ignored_primitive,
          .child = child,
          .t_low = static_cast<float>(cursor.t_enter),
          .t_high = static_cast<float>(cursor.exit.t),
          .best_t = cursor.best.t,
          .best_primitive = cursor.best.primitive,
          .any = ends_at_any_hit(ray, skips) ? 1U : 0U};
}

inline Below below(const Ray& ray, const Cursor& cursor, const Skips& skips) { return below(ray, cursor, cursor.next, skips); }

/// The part of the ray that a traversal below a child knows.
inline Ray ray_of(const Below& below) {
  return {.origin = below.origin,
          .t_max = below.t_max,
          .direction = below.direction,
          .ignored_primitive = below.ignored_primitive,
          .origin_rest = below.origin_rest,
          .direction_rest = below.direction_rest};
}

/// The cursor of a traversal that visits what is below.
template <class RayCursor = Cursor>
RayCursor cursor_of(const Below& below) {
  RayCursor cursor;
  cursor.best.t = below.best_t;
  cursor.best.primitive = below.best_primitive;
  cursor.best.leaf = Address{0};  // known to the requester
  cursor.t_enter = double{below.t_low};
  cursor.exit.t = double{below.t_high};
  cursor.next = below.child;
  cursor.waiting.count = 0;
  cursor.waiting.t_taken = 0;
  return cursor;
}

/// The hit of a finished traversal, if it differs from the one known before.
inline Hit found_below(const Below& below, const Cursor& cursor) {
  return cursor.best.primitive == below.best_primitive ? Hit{} : cursor.best;
}

/// Traverses with all records present. Found if something is nearer than the nearest hit so far.
template <Records R>
Hit trace_below(const Below& below, R& records, Operations& operations) {
  const Ray ray = ray_of(below);
  auto cursor = cursor_of(below);
  const ShearedRay sheared(ray);
  const auto test = [&](const std::byte* record, Address address, Hit& best) {
    test_leaf(ray, sheared, record, address, best, operations);
  };
  const bool visited = RayTraversal(ray, cursor, records, operations)
                           .visit_children(BoxRay(ray, reciprocal_direction(ray)), below.any != 0, meet_children, test);
  expect(visited, "whoever has a child's record has all that is below it");
  return found_below(below, cursor);
}

/// Takes what was found below a child as the nearest hit. Returns whether that ends the traversal.
inline bool take_found(const Hit& found, const Ray& ray, const Skips& skips, Cursor& cursor, Operations& operations) {
  if (found.found()) {
    expect(nearer(found.t, found.primitive, cursor.best), "what is found below a child is nearer than what was known");
    cursor.best = found;
  }
  const bool ends = ends_at_any_hit(ray, skips) && cursor.best.found();
  if (ends) {
    operations.skipped.any_hit += count_before(cursor.waiting, cursor.best);
    cursor.next = BvhChild::none();
  }
  return ends;
}

/// Merges the result of trace_below() into the requesting traversal; trace() then goes on after the child.
inline void take_below(const Hit& found, const Ray& ray, const Skips& skips, Cursor& cursor, Operations& operations) {
  if (!take_found(found, ray, skips, cursor, operations)) {
    cursor.next = cursor.waiting.take_up_to(cursor.best.t);
  }
}

}  // namespace dmpc::core
