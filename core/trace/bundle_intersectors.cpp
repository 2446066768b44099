// Intersects the rays of a bundle with one record, many rays at a time. Each ray gets exactly the numbers that
// core/trace/kernel.h computes for a single ray.
#include <algorithm>
#include <bit>

#include "core/trace/bundle_kernel.h"
#include "core/trace/instruction_set.h"

// clang-format off
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/trace/bundle_intersectors.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for each target
#include <hwy/highway.h>
#include "core/trace/lanes.inl"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace dmpc::core::HWY_NAMESPACE {

using Vector = hn::Vec<Floats>;
constexpr std::size_t step = lanes_of<Floats>();

// --- Boxes ---

/// A BVH node's bounds as floats.
using Bounds = std::array<std::array<float, bvh_children_max>, 6>;

HWY_INLINE Bounds bounds_of(const BvhNode& bvh_node) {
  Bounds bounds;
  for (std::size_t row = 0; row < 6; ++row) {
    for (std::size_t child = 0; child < bvh_children_max; ++child) {
      bounds[row][child] = static_cast<float>(bvh_node.bounds[row][child]);
    }
  }
  return bounds;
}

/// A BVH node's planes as a group of rays sees them: bound * slope + offset.
struct BoxPlanes {
  Vector slope[3], offset[3], t_low, t_high;
};

HWY_INLINE BoxPlanes planes_of(const RayBundle& bundle, const BvhNode& bvh_node, std::size_t first) {
  const Floats tag;
  BoxPlanes planes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto reciprocal = hn::Load(tag, bundle.reciprocal[axis].data() + first);
    const auto origin = hn::Load(tag, bundle.origin[axis].data() + first);
    planes.slope[axis] = hn::Mul(hn::Set(tag, bvh_node.unit), reciprocal);
    planes.offset[axis] = hn::Mul(hn::Sub(hn::Set(tag, bvh_node.origin[axis]), origin), reciprocal);
  }
  planes.t_low = hn::Load(tag, bundle.t_low.data() + first);
  planes.t_high = hn::Min(hn::Load(tag, bundle.t_high.data() + first), hn::Load(tag, bundle.best.t.data() + first));
  return planes;
}

/// Where rays enter a child's box, and which of them do.
template <bool OneOctant>
HWY_INLINE RayMask meet_box(const RayBundle& bundle, const Bounds& bounds, const BoxPlanes& planes, std::size_t child,
                            Vector& enter) {
  const Floats tag;
  Vector leave = planes.t_high;
  enter = planes.t_low;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto plane = [&](std::size_t row) {
      return fused(hn::Set(tag, bounds[row][child]), planes.slope[axis], planes.offset[axis]);
    };
    if constexpr (OneOctant) {
      enter = hn::Max(enter, plane(bundle.near_row[axis]));
      leave = hn::Min(leave, plane(bundle.far_row[axis]));
    } else {
      const Vector low = plane(axis), high = plane(axis + 3);
      enter = hn::Max(enter, hn::Min(low, high));
      leave = hn::Min(leave, hn::Max(low, high));
    }
  }
  return bits_of(tag, hn::Le(enter, leave));
}

/// Moves the last waiting child before those that are no nearer, from position `start` on.
HWY_INLINE void put_in_order(BundleChildren& waiting, std::uint32_t start) {
  std::uint32_t place = waiting.count - 1;
  const float nearest = waiting.nearest[place];
  if (place == start || waiting.nearest[place - 1] >= nearest) {
    return;
  }
  const BvhChild record = waiting.record[place];
  const RayMask rays = waiting.rays[place];
  const Row<float> t_enter = waiting.t_enter[place];
  for (; place > start && waiting.nearest[place - 1] < nearest; --place) {
    waiting.nearest[place] = waiting.nearest[place - 1];
    waiting.record[place] = waiting.record[place - 1];
    waiting.rays[place] = waiting.rays[place - 1];
    waiting.t_enter[place] = waiting.t_enter[place - 1];
  }
  waiting.nearest[place] = nearest;
  waiting.record[place] = record;
  waiting.rays[place] = rays;
  waiting.t_enter[place] = t_enter;
}

/// Which of `rays` meet each child, in a branch-free pass. take(child, first, t) is told where rays from `first` on enter.
template <bool OneOctant, class Take>
HWY_INLINE std::array<RayMask, bvh_children_max> meet_boxes(const RayBundle& bundle, const BvhNode& bvh_node, RayMask rays,
                                                            const Take& take) {
  const Bounds bounds = bounds_of(bvh_node);
  std::array<RayMask, bvh_children_max> met{};
  for (std::size_t first = 0; first < bundle_rays_max; first += step) {
    const RayMask here = rays & first_bits(step) << first;
    if (here == 0) {
      continue;
    }
    const BoxPlanes planes = planes_of(bundle, bvh_node, first);
    for (std::size_t child = 0; child < bvh_node.child_count; ++child) {
      Vector enter;
      met[child] |= meet_box<OneOctant>(bundle, bounds, planes, child, enter) << first & here;
      take(child, first, enter);
    }
  }
  return met;
}

template <bool OneOctant>
HWY_INLINE void meet_together(RayBundle& bundle, const BvhNode& bvh_node, RayMask rays) {
  BundleChildren& waiting = bundle.waiting;
  alignas(64) std::array<Row<float>, bvh_children_max> t_enter;
  const auto met = meet_boxes<OneOctant>(bundle, bvh_node, rays, [&](std::size_t child, std::size_t first, Vector enter) {
    hn::Store(enter, Floats(), t_enter[child].data() + first);
  });
  const std::uint32_t start = waiting.count;
  std::array<std::uint8_t, bvh_children_max> child_at;  // of the added ones, in order
  for (std::size_t child = 0; child < bvh_node.child_count; ++child) {
    if (met[child] == 0) {
      continue;
    }
    const float nearest = t_enter[child][static_cast<std::size_t>(std::countr_zero(met[child]))];
    std::uint32_t place = waiting.count++;
    for (; place > start && waiting.nearest[place - 1] < nearest; --place) {
      waiting.nearest[place] = waiting.nearest[place - 1];
      child_at[place - start] = child_at[place - 1 - start];
    }
    waiting.nearest[place] = nearest;
    child_at[place - start] = static_cast<std::uint8_t>(child);
  }
  for (std::uint32_t place = start; place < waiting.count; ++place) {
    const std::size_t child = child_at[place - start];
    waiting.record[place] = bvh_node.child[child];
    waiting.rays[place] = met[child];
    waiting.t_enter[place] = t_enter[child];
  }
}

/// Which children one ray meets, and where it enters them.
HWY_INLINE RayMask meet_apart(const RayBundle& bundle, const BvhNode& bvh_node, std::size_t ray, float* t_enter) {
  const hn::CappedTag<float, bvh_children_max> tag;
  const hn::Rebind<std::int32_t, decltype(tag)> integers;
  const hn::Rebind<std::uint8_t, decltype(tag)> bytes;
  constexpr std::size_t lanes = lanes_of<decltype(tag)>();
  RayMask met = 0;
  for (std::size_t first = 0; first < bvh_children_max; first += lanes) {
    auto enter = hn::Set(tag, bundle.t_low[ray]), leave = hn::Set(tag, std::min(bundle.t_high[ray], bundle.best.t[ray]));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float reciprocal = bundle.reciprocal[axis][ray];
      const auto slope = hn::Set(tag, bvh_node.unit * reciprocal);
      const auto offset = hn::Set(tag, (bvh_node.origin[axis] - bundle.origin[axis][ray]) * reciprocal);
      const auto plane = [&](std::size_t row) {
        return fused(hn::ConvertTo(tag, hn::PromoteTo(integers, hn::LoadU(bytes, bvh_node.bounds[row].data() + first))), slope,
                     offset);
      };
      const bool is_down = reciprocal < 0.0F;
      enter = hn::Max(enter, plane(is_down ? axis + 3 : axis));
      leave = hn::Min(leave, plane(is_down ? axis : axis + 3));
    }
    hn::Store(enter, tag, t_enter + first);
    met |= bits_of(tag, hn::Le(enter, leave)) << first;
  }
  return met & first_bits(bvh_node.child_count);
}

/// One ray against all boxes, after others from `start` on.
HWY_INLINE void add_apart(RayBundle& bundle, const BvhNode& bvh_node, std::size_t ray, std::uint32_t start) {
  BundleChildren& waiting = bundle.waiting;
  alignas(64) float t_enter[bvh_children_max];
  for (RayMask met = meet_apart(bundle, bvh_node, ray, t_enter); met != 0; met &= met - 1) {
    const auto child = static_cast<std::size_t>(std::countr_zero(met));
    waiting.record[waiting.count] = bvh_node.child[child];
    waiting.rays[waiting.count] = RayMask{1} << ray;
    waiting.nearest[waiting.count] = waiting.t_enter[waiting.count][ray] = t_enter[child];
    ++waiting.count;
    put_in_order(waiting, start);
  }
}

/// Adds children that some rays meet, in the node's order and without where rays enter: who has no hit wants all of them, where
/// any will do. Writes all, without a branch.
HWY_INLINE void add_any(BundleChildren& waiting, const BvhNode& bvh_node, const std::array<RayMask, bvh_children_max>& met) {
  std::uint32_t count = waiting.count;
  for (std::size_t child = 0; child < bvh_children_max; ++child) {
    waiting.record[count] = bvh_node.child[child];
    waiting.rays[count] = met[child];
    count += met[child] != 0 ? 1U : 0U;
  }
  waiting.count = count;
}

template <bool OneOctant>
HWY_INLINE void meet_any_together(RayBundle& bundle, const BvhNode& bvh_node, RayMask rays) {
  add_any(bundle.waiting, bvh_node, meet_boxes<OneOctant>(bundle, bvh_node, rays, [](std::size_t, std::size_t, Vector) {}));
}

HWY_INLINE void meet_any(RayBundle& bundle, const BvhNode& bvh_node, RayMask rays) {
  if (count_of(rays) > apart_max) {
    return bundle.is_one_octant ? meet_any_together<true>(bundle, bvh_node, rays)
                                : meet_any_together<false>(bundle, bvh_node, rays);
  }
  for (; rays != 0; rays &= rays - 1) {
    const auto ray = static_cast<std::size_t>(std::countr_zero(rays));
    alignas(64) float t_enter[bvh_children_max];
    const RayMask children = meet_apart(bundle, bvh_node, ray, t_enter);
    std::array<RayMask, bvh_children_max> met;
    for (std::size_t child = 0; child < bvh_children_max; ++child) {
      met[child] = (children >> child & 1U) << ray;
    }
    add_any(bundle.waiting, bvh_node, met);
  }
}

void meet_children(RayBundle& bundle, const BvhNode& bvh_node, RayMask rays) {
  if (bundle.any) {
    meet_any(bundle, bvh_node, rays);
  } else if (count_of(rays) <= apart_max) {
    for (const std::uint32_t start = bundle.waiting.count; rays != 0; rays &= rays - 1) {
      add_apart(bundle, bvh_node, static_cast<std::size_t>(std::countr_zero(rays)), start);
    }
  } else if (bundle.is_one_octant) {
    meet_together<true>(bundle, bvh_node, rays);
  } else {
    meet_together<false>(bundle, bvh_node, rays);
  }
}

/// Those of `rays` that enter the box of a waiting child before their best hit.
HWY_INLINE RayMask still_want(const RayBundle& bundle, std::size_t child, RayMask rays) {
  const Row<float>& t_enter = bundle.waiting.t_enter[child];
  if ((rays & (rays - 1)) == 0) {
    const auto ray = static_cast<std::size_t>(std::countr_zero(rays));
    return t_enter[ray] <= bundle.best.t[ray] ? rays : 0;
  }
  const Floats tag;
  RayMask near = 0;
  for (std::size_t first = 0; first < bundle_rays_max; first += step) {
    const auto best = hn::Load(tag, bundle.best.t.data() + first);
    near |= bits_of(tag, hn::Le(hn::Load(tag, t_enter.data() + first), best)) << first;
  }
  return rays & near;
}

void take_child(RayBundle& bundle) {
  BundleChildren& waiting = bundle.waiting;
  const RayMask done = bundle.any ? bundle.found : 0;
  while (waiting.count > 0) {
    const std::uint32_t last = --waiting.count;
    const RayMask rays = waiting.rays[last] & ~done;
    const RayMask wanted = rays == 0 || bundle.any ? rays : still_want(bundle, last, rays);
    if (wanted != 0) {
      bundle.next = waiting.record[last];
      bundle.next_rays = wanted;
      return;
    }
  }
  bundle.next = BvhChild::none();
}

std::uint64_t count_waiting(const RayBundle& bundle, RayMask rays) {
  std::uint64_t count = 0;
  for (std::size_t child = 0; child < bundle.waiting.count; ++child) {
    count += count_of(bundle.waiting.rays[child] & rays);
  }
  return count;
}

// --- Triangles ---

/// The shear of a ray.
struct Shear {
  std::size_t axis;
  bool is_down;
};

HWY_INLINE Shear shear_of(const RayBundle& bundle, std::size_t ray) {
  const auto& along = bundle.sheared_along;
  const auto is = [ray](RayMask rays) { return rays >> ray & 1U; };
  return {is(along[1][0] | along[1][1]) + 2 * is(along[2][0] | along[2][1]), is(along[0][1] | along[1][1] | along[2][1]) != 0};
}

/// Rays with the same shear, one per lane or one in all lanes, and the triangles of a leaf in their order of axes.
template <class Tag>
struct ShearedRays {
  const float *x, *y, *z;     ///< the rows of the first corner for these axes
  std::size_t corner_stride;  ///< from one corner to the next
  hn::Vec<Tag> origin_x, origin_y, origin_z, minus_shear_x, minus_shear_y;
};

/// values(row) returns those of a bundle's row for the rays.
template <class Tag, class Values>
HWY_INLINE ShearedRays<Tag> sheared_rays(Tag, const RayBundle& bundle, const TriangleRows& triangles, const Shear& shear,
                                         const Values& values) {
  const std::size_t next = (shear.axis + 1) % 3, last = (shear.axis + 2) % 3;
  const std::size_t x = shear.is_down ? last : next, y = shear.is_down ? next : last;
  return {triangles.rows + x * triangles.count,
          triangles.rows + y * triangles.count,
          triangles.rows + shear.axis * triangles.count,
          3 * triangles.count,
          values(bundle.origin[x]),
          values(bundle.origin[y]),
          values(bundle.origin[shear.axis]),
          hn::Neg(values(bundle.shear_x)),
          hn::Neg(values(bundle.shear_y))};
}

/// A vertex relative to those rays.
template <class Tag>
struct SeenVertices {
  hn::Vec<Tag> x, y, z;
};

/// load(row) returns the values of one triangle for all rays, or of several for one ray.
template <class Tag, class Load>
HWY_INLINE SeenVertices<Tag> shear(const ShearedRays<Tag>& rays, std::size_t corner, const Load& load) {
  const std::size_t skipped = corner * rays.corner_stride;
  const auto z = hn::Sub(load(rays.z + skipped), rays.origin_z);
  return {fused(rays.minus_shear_x, z, hn::Sub(load(rays.x + skipped), rays.origin_x)),
          fused(rays.minus_shear_y, z, hn::Sub(load(rays.y + skipped), rays.origin_y)), z};
}

template <class Tag>
HWY_INLINE hn::Vec<Tag> edge(const SeenVertices<Tag>& a, const SeenVertices<Tag>& b) {
  return hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x));
}

/// The lanes of `asked` whose ray passes the triangle and for which floats may be wrong, and some more: the scalar twin decides.
template <class Tag>
HWY_INLINE RayMask within_rounding(float rest, RayMask asked, const SeenVertices<Tag>& a, const SeenVertices<Tag>& b,
                                   const SeenVertices<Tag>& c, const hn::Vec<Tag>& margin) {
  const Tag tag;
  const auto across = [](const SeenVertices<Tag>& v) { return hn::Max(hn::Abs(v.x), hn::Abs(v.y)); };
  const auto widest = hn::Max(hn::Max(across(a), across(b)), across(c));
  const auto deepest = hn::Max(hn::Max(hn::Abs(a.z), hn::Abs(b.z)), hn::Abs(c.z));
  const auto rounding = hn::Mul(hn::Set(tag, edge_rounding), hn::Max(widest, deepest));
  return asked & bits_of(tag, hn::Le(margin, hn::Mul(hn::Add(rounding, hn::Set(tag, rest_weight * rest)), widest)));
}

/// Those of the lanes that doubles decide.
template <class Tag>
HWY_INLINE RayMask doubtful(const RayBundle& bundle, RayMask asked, const SeenVertices<Tag>& a, const SeenVertices<Tag>& b,
                            const SeenVertices<Tag>& c, hn::Vec<Tag> least, hn::Vec<Tag> greatest) {
  const Tag tag;
  const auto limit = hn::Set(tag, near_edge);
  const auto is_near =
      hn::And(hn::Lt(hn::Min(hn::Min(a.z, b.z), c.z), limit), hn::Gt(hn::Max(hn::Max(a.z, b.z), c.z), hn::Neg(limit)));
  asked &= bits_of(tag, is_near);
  return HWY_LIKELY(asked == 0) ? 0 : within_rounding<Tag>(bundle.rest_most, asked, a, b, c, hn::Min(hn::Neg(least), greatest));
}

/// Stores a ray's hit if it is nearer than the current one.
HWY_INLINE void take_nearer(RayBundle& bundle, std::size_t ray, const Hit& hit) {
  if (nearer(hit.t, hit.primitive, bundle.best.of(ray))) {
    bundle.best.set(ray, hit);
    bundle.found |= RayMask{1} << ray;
  }
}

/// Computes a doubtful hit with the scalar twin.
HWY_INLINE void hit_apart(RayBundle& bundle, const TriangleRows& triangles, Address leaf, std::size_t lane, std::uint32_t id,
                          std::size_t ray) {
  const float t = intersect_triangle(ShearedRay(bundle.rays[ray]), triangles.rows, triangles.count, lane);
  if (t > 0.0F && t < bundle.t_max[ray]) {
    take_nearer(bundle, ray, {t, id, leaf, static_cast<std::uint32_t>(lane)});
  }
}

/// One triangle against some of the rays from `first` on.
HWY_INLINE void hit_triangle(RayBundle& bundle, const ShearedRays<Floats>& rays, std::size_t first, RayMask active,
                             const TriangleRows& triangles, Address leaf, std::size_t lane) {
  const Floats tag;
  const Unsigned ids;
  const auto load = [lane](const float* row) { return hn::Set(Floats(), row[lane]); };
  const auto a = shear(rays, 0, load), b = shear(rays, 1, load), c = shear(rays, 2, load);
  const Vector u = edge(c, b), v = edge(a, c), w = edge(b, a), zero = hn::Zero(tag);
  const Vector least = hn::Min(hn::Min(u, v), w), greatest = hn::Max(hn::Max(u, v), w);
  const RayMask outside = bits_of(tag, hn::And(hn::Lt(least, zero), hn::Gt(greatest, zero)));
  const RayMask in_doubt = bits_of(tag, hn::Or(hn::Or(hn::Eq(u, zero), hn::Eq(v, zero)), hn::Eq(w, zero))) |
                           doubtful<Floats>(bundle, active & outside, a, b, c, least, greatest);
  if ((active & (~outside | in_doubt)) == 0) {
    return;
  }
  const auto id = read<std::uint32_t>(triangles.ids() + lane * sizeof(std::uint32_t));
  const Vector determinant = hn::Add(hn::Add(u, v), w);
  const Vector weighted =
      fused(hn::Div(u, determinant), a.z, fused(hn::Div(v, determinant), b.z, hn::Mul(hn::Div(w, determinant), c.z)));
  const Vector t = hn::Mul(weighted, hn::Load(tag, bundle.scale_z.data() + first));
  const auto ignored = hn::Eq(hn::Load(ids, bundle.ignored_primitive.data() + first), hn::Set(ids, id));
  const RayMask others = active & ~bits_of(ids, ignored);
  const RayMask crossed = others & ~outside & ~bits_of(tag, hn::Eq(determinant, zero));
  RayMask unsettled = (in_doubt & others) | (crossed & bits_of(tag, hn::Lt(hn::Abs(t), hn::Set(tag, near_start))));
  const Vector best = hn::Load(tag, bundle.best.t.data() + first);
  const auto in_time = hn::And(hn::Gt(t, zero), hn::Lt(t, hn::Load(tag, bundle.t_max.data() + first)));
  const auto has_lower_id = hn::RebindMask(tag, hn::Gt(hn::Load(ids, bundle.best.primitive.data() + first), hn::Set(ids, id)));
  const auto is_nearer = hn::Or(hn::Lt(t, best), hn::And(hn::Eq(t, best), has_lower_id));
  const RayMask hit = crossed & ~unsettled & bits_of(tag, hn::And(in_time, is_nearer));
  if (hit != 0) {
    const auto takes = mask_of(tag, hit);
    const auto takes_ids = hn::RebindMask(ids, takes);
    hn::BlendedStore(t, takes, tag, bundle.best.t.data() + first);
    hn::BlendedStore(hn::Set(ids, id), takes_ids, ids, bundle.best.primitive.data() + first);
    hn::BlendedStore(hn::Set(ids, static_cast<std::uint32_t>(leaf)), takes_ids, ids, bundle.best.leaf.data() + first);
    hn::BlendedStore(hn::Set(ids, static_cast<std::uint32_t>(lane)), takes_ids, ids, bundle.best.lane.data() + first);
    bundle.found |= hit << first;
  }
  for (; unsettled != 0; unsettled &= unsettled - 1) {
    hit_apart(bundle, triangles, leaf, lane, id, first + static_cast<std::size_t>(std::countr_zero(unsettled)));
  }
}

/// Rays with the same shear against all triangles, one after the other.
HWY_INLINE void hit_together(RayBundle& bundle, const TriangleRows& triangles, Address leaf, RayMask rays, const Shear& shear) {
  for (std::size_t first = 0; first < bundle_rays_max; first += step) {
    RayMask active = rays >> first & first_bits(step);
    if (active == 0) {
      continue;
    }
    const auto values = [first](const Row<float>& row) { return hn::Load(Floats(), row.data() + first); };
    const auto sheared = sheared_rays(Floats(), bundle, triangles, shear, values);
    for (std::size_t lane = 0; lane < triangles.count && active != 0; ++lane) {
      if ((triangles.left_out >> lane & 1U) != 0) {
        continue;
      }
      hit_triangle(bundle, sheared, first, active, triangles, leaf, lane);
      active &= ~(bundle.any ? bundle.found >> first : 0U);
    }
  }
}

using LeafFloats = hn::CappedTag<float, leaf_lanes>;

/// One ray against the triangles of `active`, from `first` on: finds the nearest hit.
HWY_INLINE void hit_lanes(RayBundle& bundle, const ShearedRays<LeafFloats>& rays, std::size_t ray, std::size_t first,
                          RayMask active, const TriangleRows& triangles, Address leaf) {
  const LeafFloats tag;
  const hn::Rebind<std::uint32_t, LeafFloats> ids;
  const auto load = [first](const float* row) { return hn::LoadU(LeafFloats(), row + first); };
  const auto a = shear(rays, 0, load), b = shear(rays, 1, load), c = shear(rays, 2, load);
  const auto u = edge(c, b), v = edge(a, c), w = edge(b, a), zero = hn::Zero(tag);
  const auto least = hn::Min(hn::Min(u, v), w), greatest = hn::Max(hn::Max(u, v), w);
  const RayMask outside = bits_of(tag, hn::And(hn::Lt(least, zero), hn::Gt(greatest, zero)));
  const RayMask in_doubt = bits_of(tag, hn::Or(hn::Or(hn::Eq(u, zero), hn::Eq(v, zero)), hn::Eq(w, zero))) |
                           doubtful<LeafFloats>(bundle, active & outside, a, b, c, least, greatest);
  if ((active & (~outside | in_doubt)) == 0) {
    return;
  }
  const auto* const id = reinterpret_cast<const std::uint32_t*>(triangles.ids()) + first;
  const auto determinant = hn::Add(hn::Add(u, v), w);
  const auto weighted =
      fused(hn::Div(u, determinant), a.z, fused(hn::Div(v, determinant), b.z, hn::Mul(hn::Div(w, determinant), c.z)));
  const auto t = hn::Mul(weighted, hn::Set(tag, bundle.scale_z[ray]));
  const RayMask others = active & ~bits_of(ids, hn::Eq(hn::LoadU(ids, id), hn::Set(ids, bundle.ignored_primitive[ray])));
  const RayMask crossed = others & ~outside & ~bits_of(tag, hn::Eq(determinant, zero));
  RayMask unsettled = (in_doubt & others) | (crossed & bits_of(tag, hn::Lt(hn::Abs(t), hn::Set(tag, near_start))));
  const auto in_time = hn::And(hn::Gt(t, zero), hn::Lt(t, hn::Set(tag, bundle.t_max[ray])));
  const auto is_near = hn::Le(t, hn::Set(tag, bundle.best.t[ray]));
  RayMask hits = crossed & ~unsettled & bits_of(tag, hn::And(in_time, is_near));
  alignas(64) float times[leaf_lanes];
  hn::Store(t, tag, times);
  for (; hits != 0; hits &= hits - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(hits));
    take_nearer(bundle, ray, {times[lane], id[lane], leaf, static_cast<std::uint32_t>(first + lane)});
  }
  for (; unsettled != 0; unsettled &= unsettled - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(unsettled));
    hit_apart(bundle, triangles, leaf, first + lane, id[lane], ray);
  }
}

/// Each of the rays against all triangles.
HWY_INLINE void hit_one_by_one(RayBundle& bundle, const TriangleRows& triangles, Address leaf, RayMask rays, const Shear& shear) {
  const RayMask tested = first_bits(triangles.count) & ~triangles.left_out;
  for (; rays != 0; rays &= rays - 1) {
    const auto ray = static_cast<std::size_t>(std::countr_zero(rays));
    const auto values = [ray](const Row<float>& row) { return hn::Set(LeafFloats(), row[ray]); };
    const auto sheared = sheared_rays(LeafFloats(), bundle, triangles, shear, values);
    for (std::size_t first = 0; first < triangles.count; first += lanes_of<LeafFloats>()) {
      const RayMask active = tested >> first & first_bits(lanes_of<LeafFloats>());
      hit_lanes(bundle, sheared, ray, first, active, triangles, leaf);
    }
  }
}

/// One ray with all triangles costs about as much as one triangle with all rays, so the fewer of the two are looped over.
void hit_triangles(RayBundle& bundle, const TriangleRows& triangles, Address leaf, RayMask rays) {
  while (rays != 0) {
    const Shear shear = shear_of(bundle, static_cast<std::size_t>(std::countr_zero(rays)));
    const RayMask alike = rays & bundle.sheared_along[shear.axis][shear.is_down ? 1 : 0];
    if (count_of(alike) > triangles.count) {
      hit_together(bundle, triangles, leaf, alike, shear);
    } else {
      hit_one_by_one(bundle, triangles, leaf, alike, shear);
    }
    rays &= ~alike;
  }
}

const BundleIntersectors* intersectors() {
  static constexpr BundleIntersectors all{meet_children, take_child, count_waiting, hit_triangles};
  return &all;
}

}  // namespace dmpc::core::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace dmpc::core {
const BundleIntersectors* bundle_intersectors(std::size_t rank) {
  const auto compiled = DMPC_COMPILED_FOR(rank, intersectors);
  return compiled != nullptr ? compiled() : nullptr;
}

const BundleIntersectors& fastest_bundle_intersectors = *bundle_intersectors(0);

}  // namespace dmpc::core
#endif
