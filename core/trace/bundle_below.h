// The part of a bundle's traversal that another node does: what its rays hit below a child whose record is absent.
#pragma once

#include <cstddef>
#include <span>

#include "core/base/expect.h"
#include "core/record/hit.h"
#include "core/record/records.h"
#include "core/trace/below.h"
#include "core/trace/bundle.h"
#include "core/trace/bundle_kernel.h"
#include "core/trace/bundle_traversal.h"
#include "core/trace/operations.h"
#include "core/trace/skips.h"

namespace dmpc::core {

/// For one of bundle.next_rays, if bundle.next is absent.
inline Below below(const RayBundle& bundle, std::size_t ray) {
  expect(bundle.stage == RayBundle::Stage::child && bundle.next.found(),
         "a bundle that waits for a child is below the directory");
  const Ray& whole = bundle.rays[ray];
  return {.origin = whole.origin,
          .origin_rest = whole.origin_rest,
          .direction = whole.direction,
          .direction_rest = whole.direction_rest,
          .t_max = whole.t_max,
          .ignored_primitive = whole.ignored_primitive,
          .child = bundle.next,
          .t_low = bundle.t_low[ray],
          .t_high = bundle.t_high[ray],
          .best_t = bundle.best.t[ray],
          .best_primitive = bundle.best.primitive[ray],
          .any = bundle.any ? 1U : 0U};
}

/// Makes `bundle` of rays that go on below one child.
inline void set_rays(RayBundle& bundle, std::span<const Below> rays, const DatabaseHeader& header) {
  expect(!rays.empty() && rays.size() <= bundle_rays_max, "a bundle has up to 16 rays");
  bundle.count = static_cast<std::uint32_t>(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    bundle.rays[i] = ray_of(rays[i]);
  }
  for (std::size_t i = 0; i < bundle_rays_max; ++i) {
    const Below& ray = rays[i < rays.size() ? i : 0];  // no lane computes with values that are not set
    expect(ray.child.bits == rays[0].child.bits && ray.any == rays[0].any, "the rays of a bundle go on below one child");
    bundle.t_low[i] = ray.t_low;
    bundle.t_high[i] = ray.t_high;
    bundle.best.set(i, {.t = ray.best_t, .primitive = ray.best_primitive, .leaf = Address{0}});  // known to the requester
  }
  bundle.start();
  bundle.arrived = (RayMask{1} << bundle_rays_max) - 1;  // nobody looks where they enter the grid
  fastest_bundle_steps.enter(bundle, header.frame, header.region);
  bundle.found = 0;
  bundle.any = rays[0].any != 0;
  bundle.next = rays[0].child;
  bundle.next_rays = bundle.all();
  bundle.waiting.count = 0;
}

/// trace_below() for several rays, which had shared a bundle: then found_below() has what each has found.
template <Records R>
void trace_below(RayBundle& bundle, std::span<const Below> rays, R& records, const DatabaseHeader& header,
                 Operations& operations) {
  set_rays(bundle, rays, header);
  BundleTraversal<R>(bundle, records, header, {}, operations).visit_below();
}

/// Found if something is nearer than the nearest hit before.
inline Hit found_below(const RayBundle& bundle, std::size_t ray) {
  return (bundle.found >> ray & 1U) != 0 ? bundle.best.of(ray) : Hit{};
}

/// Takes what one of bundle.next_rays has found below bundle.next, which then no longer waits. Returns whether that was the last:
/// trace() then goes on after the child.
inline bool take_below(RayBundle& bundle, std::size_t ray, const Hit& found, Operations& operations) {
  const RayMask bit = RayMask{1} << ray;
  expect((bundle.next_rays & bit) != 0, "a ray that waits takes what was found, once");
  if (found.found()) {
    expect(nearer(found.t, found.primitive, bundle.best.of(ray)), "what is found below a child is nearer than what was known");
    bundle.best.set(ray, found);
    bundle.found |= bit;
    operations.skipped.any_hit += bundle.any ? fastest_bundle_intersectors.count_waiting(bundle, bit) : 0;
  }
  bundle.next_rays &= ~bit;
  if (bundle.next_rays != 0) {
    return false;
  }
  fastest_bundle_intersectors.take_child(bundle);
  return true;
}

}  // namespace dmpc::core
