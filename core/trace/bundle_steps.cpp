// Moves the rays of a bundle from cell to cell, many at a time. Each ray gets exactly the numbers that
// core/trace/cell_traversal.h computes for a single ray.
#include <algorithm>
#include <bit>
#include <limits>

#include "core/trace/bundle_kernel.h"
#include "core/trace/instruction_set.h"
#include "core/trace/ray_planes.h"

// clang-format off
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/trace/bundle_steps.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for each target
#include <hwy/highway.h>
#include "core/trace/lanes.inl"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace dmpc::core::HWY_NAMESPACE {

constexpr double never = std::numeric_limits<double>::infinity();

// --- From rays to rows ---

using Four = hn::CappedTag<float, 4>;

/// The four floats of each ray. The first ray is repeated after the last one, so that no lane computes with uninitialised values.
HWY_INLINE const float* floats_of(const RayBundle& bundle, std::size_t ray, std::size_t offset) {
  const auto* bytes = reinterpret_cast<const std::byte*>(&bundle.rays[ray < bundle.count ? ray : 0]) + offset;
  return reinterpret_cast<const float*>(bytes);
}

/// Transposes four floats of each ray to four rows.
HWY_INLINE void load_rows(const RayBundle& bundle, std::size_t offset, float* row0, float* row1, float* row2, float* row3) {
#if HWY_TARGET == HWY_SCALAR
  for (std::size_t i = 0; i < bundle.count; ++i) {
    const float* const from = floats_of(bundle, i, offset);
    row0[i] = from[0];
    row1[i] = from[1];
    row2[i] = from[2];
    row3[i] = from[3];
  }
#else
  const Four tag;
  for (std::size_t i = 0; i < bundle.count; i += 4) {
    const auto four = [&](std::size_t ray) { return hn::LoadU(tag, floats_of(bundle, i + ray, offset)); };
    const auto a = four(0), b = four(1), c = four(2), d = four(3);
    const auto ab_low = hn::InterleaveLower(tag, a, b), ab_high = hn::InterleaveUpper(tag, a, b);
    const auto cd_low = hn::InterleaveLower(tag, c, d), cd_high = hn::InterleaveUpper(tag, c, d);
    hn::StoreU(hn::ConcatLowerLower(tag, cd_low, ab_low), tag, row0 + i);
    hn::StoreU(hn::ConcatUpperUpper(tag, cd_low, ab_low), tag, row1 + i);
    hn::StoreU(hn::ConcatLowerLower(tag, cd_high, ab_high), tag, row2 + i);
    hn::StoreU(hn::ConcatUpperUpper(tag, cd_high, ab_high), tag, row3 + i);
  }
#endif
}

/// The largest rest of all rays' origins; NaN is ignored.
HWY_INLINE float largest_rest(const RayBundle& bundle) {
  const Four tag;
  alignas(16) float each[4] = {};
  for (std::size_t axis = 0; axis < 3; axis += lanes_of<Four>()) {
    auto largest = hn::Zero(tag);
    for (std::size_t i = 0; i < bundle.count; ++i) {
      const float* const rests = floats_of(bundle, i, offsetof(Ray, origin_rest));
      largest = hn::Max(hn::Abs(hn::LoadU(tag, rests + axis)), largest);
    }
    hn::Store(largest, tag, each + axis);
  }
  return std::max({each[0], each[1], each[2]});
}

HWY_INLINE void load(RayBundle& bundle) {
  load_rows(bundle, offsetof(Ray, origin), bundle.origin[0].data(), bundle.origin[1].data(), bundle.origin[2].data(),
            bundle.t_max.data());
  Row<float> ignored;
  load_rows(bundle, offsetof(Ray, direction), bundle.direction[0].data(), bundle.direction[1].data(), bundle.direction[2].data(),
            ignored.data());
  std::memcpy(bundle.ignored_primitive.data(), ignored.data(), sizeof(ignored));
  bundle.rest_most = largest_rest(bundle);
}

/// Rays have no candidate unless they brought one along.
HWY_INLINE void clear_hits(RayBundle& bundle) {
  bundle.found = 0;
  if (bundle.arrived == 0) {
    bundle.best.t.fill(std::numeric_limits<float>::infinity());
    bundle.best.primitive.fill(no_primitive);
    bundle.best.leaf.fill(static_cast<std::uint32_t>(no_address));
    bundle.best.lane.fill(0);
    return;
  }
  for (std::size_t ray = 0; ray < bundle_rays_max; ++ray) {
    if ((bundle.arrived >> ray & 1U) == 0) {
      bundle.best.set(ray, {});
    }
    bundle.found |= (Address{bundle.best.leaf[ray]} != no_address ? RayMask{1} : RayMask{0}) << ray;
  }
}

/// The rays whose direction has a sign, or is longest along an axis.
struct RayBits {
  std::array<RayMask, 3> forward{}, below{};
  RayMask along_x = 0, along_y = 0, down = 0, finite = 0;
};

/// ShearedRay's constructor for the rays from `first` on.
HWY_INLINE void shear(RayBundle& bundle, std::size_t first, RayBits& bits) {
  const Floats tag;
  const auto d = [&](std::size_t axis) { return hn::Load(tag, bundle.direction[axis].data() + first); };
  const auto d0 = d(0), d1 = d(1), d2 = d(2);
  const auto x = hn::Abs(d0), y = hn::Abs(d1), z = hn::Abs(d2);
  const auto x_over_y = hn::Gt(x, y);
  const auto is_x = hn::And(x_over_y, hn::Gt(x, z));
  const auto is_y = hn::AndNot(x_over_y, hn::Gt(y, z));
  const auto choose = [&](auto if_x, auto if_y, auto if_z) {
    return hn::IfThenElse(is_x, if_x, hn::IfThenElse(is_y, if_y, if_z));
  };
  const auto along = choose(d0, d1, d2), next = choose(d1, d2, d0), last = choose(d2, d0, d1);
  const auto is_down = hn::Lt(along, hn::Zero(tag));
  const auto scale = hn::Div(hn::Set(tag, 1.0F), along);
  hn::Store(scale, tag, bundle.scale_z.data() + first);
  hn::Store(hn::Mul(hn::IfThenElse(is_down, last, next), scale), tag, bundle.shear_x.data() + first);
  hn::Store(hn::Mul(hn::IfThenElse(is_down, next, last), scale), tag, bundle.shear_y.data() + first);
  bits.along_x |= bits_of(tag, is_x) << first;
  bits.along_y |= bits_of(tag, is_y) << first;
  bits.down |= bits_of(tag, is_down) << first;
}

/// Reciprocals of the directions from `first` on: as in double and then rounded, since a double has more than twice a float's
/// bits. -0 and values that count as 0 have the direction of their sign.
HWY_INLINE void find_reciprocals(RayBundle& bundle, std::size_t first, RayBits& bits) {
  const Floats tag;
  const auto small = hn::Set(tag, smallest_component), zero = hn::Zero(tag);
  auto sum = zero;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto d = hn::Load(tag, bundle.direction[axis].data() + first);
    const auto origin = hn::Load(tag, bundle.origin[axis].data() + first);
    sum = hn::Add(sum, hn::Mul(hn::Add(hn::Mul(d, zero), origin), zero));
    const auto nonzero = hn::IfThenElse(hn::Ge(hn::Abs(d), small), d, hn::CopySign(small, d));
    const auto reciprocal = hn::Div(hn::Set(tag, 1.0F), nonzero);
    hn::Store(reciprocal, tag, bundle.reciprocal[axis].data() + first);
    bits.forward[axis] |= bits_of(tag, hn::Ge(d, small)) << first;
    bits.below[axis] |= bits_of(tag, hn::Lt(reciprocal, zero)) << first;
  }
  bits.finite |= bits_of(tag, hn::Eq(sum, zero)) << first;
}

HWY_INLINE void find_shears(RayBundle& bundle, const RayBits& bits) {
  const std::array<RayMask, 3> along{bits.along_x, bits.along_y, bundle.all() & ~(bits.along_x | bits.along_y)};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    bundle.sheared_along[axis] = {along[axis] & ~bits.down, along[axis] & bits.down};
  }
}

/// Finds the rows of a BVH node's bounds that all rays reach first, if all have the same direction along each axis.
HWY_INLINE void find_octant(RayBundle& bundle, const RayBits& bits) {
  const RayMask all = bundle.all();
  bundle.is_one_octant = true;
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    const RayMask below = bits.below[axis] & all;
    bundle.is_one_octant = bundle.is_one_octant && (below == 0 || below == all);
    bundle.near_row[axis] = below == all ? axis + 3 : axis;
    bundle.far_row[axis] = below == all ? axis : axis + 3;
  }
}

/// Finds what follows from the rays alone; returns those all of whose numbers are finite.
HWY_INLINE RayMask find_directions(RayBundle& bundle) {
  RayBits bits;
  for (std::size_t first = 0; first < bundle.count; first += lanes_of<Floats>()) {
    shear(bundle, first, bits);
    find_reciprocals(bundle, first, bits);
  }
  bundle.forward = bits.forward;
  find_shears(bundle, bits);
  find_octant(bundle, bits);
  return bits.finite & bundle.all();
}

/// The starts of rays along an axis, relative to the grid's begin.
HWY_INLINE hn::Vec<Doubles> from_grid(const RayBundle& bundle, std::size_t axis, std::size_t first) {
  const Doubles tag;
  const HalfFloats half;
  return hn::Sub(hn::PromoteTo(tag, hn::Load(half, bundle.origin[axis].data() + first)), hn::Set(tag, bundle.grid_low[axis]));
}

/// CellTraversal's constructor for the rays from `first` on.
HWY_INLINE void find_planes(RayBundle& bundle, const GridFrame& frame, std::size_t first) {
  const Doubles tag;
  const HalfFloats half;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto d = hn::PromoteTo(tag, hn::Load(half, bundle.direction[axis].data() + first));
    const auto steps = hn::Ge(hn::Abs(d), hn::Set(tag, double{smallest_component}));
    const auto reciprocal = hn::Div(hn::Set(tag, 1.0), d);
    const auto slope = hn::Mul(hn::Set(tag, double{frame.finest_cell}), reciprocal);
    hn::Store(hn::IfThenElseZero(steps, slope), tag, bundle.slope[axis].data() + first);
    const auto offset = hn::Mul(hn::Neg(from_grid(bundle, axis, first)), reciprocal);
    hn::Store(hn::IfThenElse(steps, offset, hn::Set(tag, never)), tag, bundle.offset[axis].data() + first);
  }
}

/// Those of the rays from `first` on that cross planes of the axis.
HWY_INLINE hn::Mask<Doubles> has_step(const RayBundle& bundle, std::size_t axis, std::size_t first) {
  const Doubles tag;
  return hn::Ne(hn::Load(tag, bundle.slope[axis].data() + first), hn::Zero(tag));
}

// --- Planes and cells ---

/// CellTraversal::plane().
HWY_INLINE hn::Vec<Doubles> plane(const RayBundle& bundle, std::size_t axis, std::size_t first, std::int32_t index) {
  const Doubles tag;
  return hn::Add(hn::Mul(hn::Set(tag, static_cast<double>(index)), hn::Load(tag, bundle.slope[axis].data() + first)),
                 hn::Load(tag, bundle.offset[axis].data() + first));
}

/// CellTraversal::crossed().
bool crossed(const RayBundle& bundle, std::size_t ray, std::size_t axis, std::int32_t index, double t, std::size_t entry_axis) {
  const double at = static_cast<double>(index) * bundle.slope[axis][ray] + bundle.offset[axis][ray];
  return at < t || (at == t && (axis < entry_axis || entry_axis == traversal_starts));
}

/// The finest cells along an axis to which a search is limited.
struct Cells {
  std::int32_t low, high;
};

/// CellTraversal::locate(), starting from a guess.
std::int32_t locate(const RayBundle& bundle, std::size_t ray, std::size_t axis, double t, std::int32_t cell, const Cells& among,
                    std::size_t entry_axis) {
  const double slope = bundle.slope[axis][ray];
  const std::int32_t step = slope > 0.0 ? 1 : slope < 0.0 ? -1 : 0;
  return settle(cell, among.low, among.high, step,
                [&](std::int32_t index) { return crossed(bundle, ray, axis, index, t, entry_axis); });
}

/// RayPlanes::place() for the rays from `first` on.
HWY_INLINE hn::Vec<Doubles> place(const RayBundle& bundle, std::size_t axis, std::size_t first, hn::Vec<Doubles> t) {
  const Doubles tag;
  const HalfFloats half;
  const auto origin = from_grid(bundle, axis, first);
  const auto direction = hn::PromoteTo(tag, hn::Load(half, bundle.direction[axis].data() + first));
  const auto along = hn::IfThenElse(has_step(bundle, axis, first), hn::Add(origin, hn::Mul(t, direction)), origin);
  return hn::Mul(along, hn::Set(tag, bundle.finest_cells));
}

/// CellTraversal::locate_macro() along an axis, for the wanted rays from `first` on.
HWY_INLINE void locate_macro(RayBundle& bundle, std::size_t axis, std::size_t first, RayMask wanted, hn::Vec<Doubles> t,
                             const Cells& among, std::size_t entry_axis) {
  const Doubles tag;
  const HalfIntegers integers;
  if (((among.low ^ (among.high - 1)) & -finest_per_macro) == 0) {  // all in one macro cell
    hn::BlendedStore(hn::Set(integers, among.low & -finest_per_macro), mask_of(integers, wanted), integers,
                     bundle.cells[axis].data() + first);
    return;
  }
  const auto guess = hn::Min(hn::Max(place(bundle, axis, first, t), hn::Set(tag, static_cast<double>(among.low))),
                             hn::Set(tag, static_cast<double>(among.high - 1)));
  const auto cell = hn::DemoteTo(integers, guess);
  const auto inside = hn::And(cell, hn::Set(integers, finest_per_macro - 1));
  const RayMask certain =
      bits_of(integers, hn::And(hn::Gt(inside, hn::Zero(integers)), hn::Lt(inside, hn::Set(integers, finest_per_macro - 1)))) &
      bits_of(tag, hn::Lt(t, hn::Set(tag, near_t_max)));
  hn::BlendedStore(hn::And(cell, hn::Set(integers, -finest_per_macro)), mask_of(integers, wanted), integers,
                   bundle.cells[axis].data() + first);
  RayMask rest = wanted & ~certain;
  if (rest == 0) {
    return;
  }
  alignas(64) Row<double> at;
  alignas(64) Row<std::int32_t> guessed;
  hn::Store(t, tag, at.data());
  hn::Store(cell, integers, guessed.data());
  for (; rest != 0; rest &= rest - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(rest));
    bundle.cells[axis][first + i] = locate(bundle, first + i, axis, at[i], guessed[i], among, entry_axis) & -finest_per_macro;
  }
}

/// CellTraversal::finest_cell_of() along an axis, for the wanted rays where they enter their cells, into `arrival`. Planes at
/// equal t of the axes in `ties` are crossed first. Searches the whole grid, as any limits around the cell would do.
HWY_INLINE void find_finest(RayBundle& bundle, std::size_t axis, RayMask wanted, RayMask ties) {
  const Doubles tag;
  const HalfIntegers integers;
  const std::int32_t size = bundle.grid_size[axis];
  for (std::size_t first = 0; first < bundle_rays_max; first += lanes_of<Doubles>()) {
    const RayMask here = wanted >> first & first_bits(lanes_of<Doubles>());
    if (here == 0) {
      continue;
    }
    const auto t = hn::Load(tag, bundle.t_enter.data() + first);
    const auto guess =
        hn::Min(hn::Max(place(bundle, axis, first, t), hn::Zero(tag)), hn::Set(tag, static_cast<double>(size - 1)));
    const auto cell = hn::DemoteTo(integers, guess);
    hn::BlendedStore(cell, mask_of(integers, here), integers, bundle.arrival[axis].data() + first);
    const auto slope = hn::Load(tag, bundle.slope[axis].data() + first);
    const auto crossed_before = [&](hn::Vec<HalfIntegers> index) {
      const auto at = hn::Add(hn::Mul(hn::PromoteTo(tag, index), slope), hn::Load(tag, bundle.offset[axis].data() + first));
      return bits_of(tag, hn::Lt(at, t)) | (bits_of(tag, hn::Eq(at, t)) & ties >> first);
    };
    const RayMask low = crossed_before(cell), high = crossed_before(hn::Add(cell, hn::Set(integers, 1)));
    const RayMask forward = bundle.forward[axis] >> first, backward = bits_of(tag, hn::Lt(slope, hn::Zero(tag)));
    for (RayMask off = here & ((forward & (~low | high)) | (backward & (low | ~high))); off != 0; off &= off - 1) {
      const std::size_t ray = first + static_cast<std::size_t>(std::countr_zero(off));
      const std::size_t entry_axis = (ties >> ray & 1U) != 0 ? traversal_starts : 0;
      std::int32_t& found = bundle.arrival[axis][ray];
      found = locate(bundle, ray, axis, bundle.t_enter[ray], found, {0, size}, entry_axis);
    }
  }
}

/// Stores the plane through which rays enter their cells.
HWY_INLINE void set_entry(RayBundle& bundle, RayMask rays, std::size_t axis) {
  for (; rays != 0; rays &= rays - 1) {
    bundle.entry_axis[static_cast<std::size_t>(std::countr_zero(rays))] = static_cast<std::uint8_t>(axis);
  }
}

/// Those of `rays` whose macro cell lies completely in the region.
HWY_INLINE RayMask well_inside(const RayBundle& bundle, RayMask rays) {
  const Integers tag;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto low = hn::Set(tag, bundle.region.low[axis]), high = hn::Set(tag, bundle.region.high[axis] - finest_per_macro);
    RayMask outside = 0;
    for (std::size_t first = 0; first < bundle_rays_max; first += lanes_of<Integers>()) {
      const auto cells = hn::Load(tag, bundle.cells[axis].data() + first);
      outside |= bits_of(tag, hn::Or(hn::Lt(cells, low), hn::Gt(cells, high))) << first;
    }
    rays &= ~outside;
  }
  return rays;
}

/// Whether the finest cells of rays from `first` on at t certainly lie in `among`, by a guess that is off by less than a finest
/// cell.
HWY_INLINE RayMask surely_among(const RayBundle& bundle, std::size_t axis, std::size_t first, const Cells& among) {
  const Doubles tag;
  const auto t = hn::Load(tag, bundle.t_enter.data() + first);
  const auto at = place(bundle, axis, first, t);
  const auto is_inside = hn::And(hn::Gt(at, hn::Set(tag, static_cast<double>(among.low) + 1.0)),
                                 hn::Lt(at, hn::Set(tag, static_cast<double>(among.high) - 1.0)));
  return bits_of(tag, hn::And(is_inside, hn::Lt(t, hn::Set(tag, near_t_max))));
}

/// Those of `rays` that are certainly in the region, although their macro cells are not.
RayMask surely_inside(const RayBundle& bundle, RayMask rays, std::size_t entry_axis, std::int32_t face) {
  for (std::size_t axis = 0; axis < 3 && rays != 0; ++axis) {
    const Cells among{bundle.region.low[axis], bundle.region.high[axis]};
    if (axis == entry_axis) {
      rays = face >= among.low && face < among.high ? rays : 0;
      continue;
    }
    const Cells beyond{among.low > 0 ? among.low : -2, among.high < bundle.grid_size[axis] ? among.high : among.high + 2};
    RayMask inside = 0;
    for (std::size_t first = 0; first < bundle_rays_max; first += lanes_of<Doubles>()) {
      if ((rays >> first & first_bits(lanes_of<Doubles>())) != 0) {
        inside |= surely_among(bundle, axis, first, beyond) << first;
      }
    }
    rays &= inside;
  }
  return rays;
}

/// Those of `rays` whose finest cell, in `arrival`, lies in the region.
HWY_INLINE RayMask arrived_inside(const RayBundle& bundle, RayMask rays) {
  const Integers tag;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto low = hn::Set(tag, bundle.region.low[axis]), last = hn::Set(tag, bundle.region.high[axis] - 1);
    RayMask outside = 0;
    for (std::size_t first = 0; first < bundle_rays_max; first += lanes_of<Integers>()) {
      const auto cells = hn::Load(tag, bundle.arrival[axis].data() + first);
      outside |= bits_of(tag, hn::Or(hn::Lt(cells, low), hn::Gt(cells, last))) << first;
    }
    rays &= ~outside;
  }
  return rays;
}

/// CellTraversal::stays(): those of `rays` that have not left the region. Stores where the others have gone.
RayMask stay(RayBundle& bundle, RayMask rays, std::size_t entry_axis, std::int32_t face) {
  if (rays == 0) {
    return 0;
  }
  RayMask inside = well_inside(bundle, rays);
  inside |= surely_inside(bundle, rays & ~inside, entry_axis, face);
  const RayMask rest = rays & ~inside;
  if (rest == 0) {
    return inside;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (axis != entry_axis) {
      find_finest(bundle, axis, rest, axis < entry_axis ? rest : 0);
    }
  }
  for (RayMask rays_left = entry_axis < 3 ? rest : 0; rays_left != 0; rays_left &= rays_left - 1) {
    bundle.arrival[entry_axis][static_cast<std::size_t>(std::countr_zero(rays_left))] = face;
  }
  inside |= arrived_inside(bundle, rest);
  bundle.left |= rest & ~inside;
  set_entry(bundle, rest & ~inside, entry_axis);
  return inside;
}

/// CellTraversal::enter() for the rays of `finite` from `first` on: those that hit the grid.
HWY_INLINE RayMask enter_grid(RayBundle& bundle, RayMask finite, std::size_t first) {
  const Doubles tag;
  const HalfFloats half;
  const auto zero = hn::Zero(tag);
  auto t_enter = zero, t_exit = hn::PromoteTo(tag, hn::Load(half, bundle.t_max.data() + first));
  RayMask inside = (finite & ~bundle.arrived) >> first;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto steps = has_step(bundle, axis, first);
    const auto low = plane(bundle, axis, first, 0), high = plane(bundle, axis, first, bundle.grid_size[axis]);
    t_enter = hn::Max(t_enter, hn::IfThenElseZero(steps, hn::Min(low, high)));
    t_exit = hn::Min(t_exit, hn::Max(low, high));  // infinite without a step
    if (!hn::AllTrue(tag, steps)) {
      const auto at = hn::Mul(from_grid(bundle, axis, first), hn::Set(tag, bundle.finest_cells));
      const auto between = hn::And(hn::Ge(at, zero), hn::Lt(at, hn::Set(tag, static_cast<double>(bundle.grid_size[axis]))));
      inside &= bits_of(tag, hn::Or(steps, between));
    }
  }
  inside &= bits_of(tag, hn::Lt(t_enter, t_exit));
  hn::BlendedStore(t_enter, mask_of(tag, ~(bundle.arrived >> first)), tag, bundle.t_enter.data() + first);
  for (std::size_t axis = 0; axis < 3 && inside != 0; ++axis) {
    locate_macro(bundle, axis, first, inside, t_enter, {0, bundle.grid_size[axis]}, traversal_starts);
  }
  return inside;
}

void enter(RayBundle& bundle, const GridFrame& frame, const Region& region) {
  bundle.grid_size = grid_size(frame);
  bundle.region = region;
  bundle.is_whole = is_whole(region, bundle.grid_size);
  bundle.grid_low = frame.low;
  bundle.finest_cells = 1.0 / double{frame.finest_cell};
  clear_hits(bundle);
  load(bundle);
  const RayMask finite = find_directions(bundle);
  bundle.alive = bundle.left = 0;
  for (std::size_t first = 0; first < bundle.count; first += lanes_of<Doubles>()) {
    find_planes(bundle, frame, first);
    const bool have_arrived = (~bundle.arrived >> first & first_bits(lanes_of<Doubles>())) == 0;
    bundle.alive |= have_arrived ? 0 : enter_grid(bundle, finite, first) << first;
  }
  if (!bundle.is_whole) {
    bundle.alive = stay(bundle, bundle.alive, traversal_starts, 0);
  }
  bundle.alive |= bundle.arrived;
}

/// The position of a cell along the direction of the first ray.
HWY_INLINE hn::Vec<Integers> progress(const RayBundle& bundle, std::size_t first) {
  const Integers tag;
  auto sum = hn::Zero(tag);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto cells = hn::Load(tag, bundle.cells[axis].data() + first);
    sum = (bundle.forward[axis] & 1U) != 0 ? hn::Add(sum, cells) : hn::Sub(sum, cells);
  }
  return sum;
}

/// Selects the rays of `candidates` that are in the cell of one of them.
HWY_INLINE void select_cell_of(RayBundle& bundle, RayMask candidates) {
  const Integers tag;
  const auto leader = static_cast<std::size_t>(std::countr_zero(candidates));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    bundle.cell[axis] = bundle.cells[axis][leader];
    RayMask same = 0;
    for (std::size_t first = 0; first < bundle_rays_max; first += lanes_of<Integers>()) {
      same |= bits_of(tag, hn::Eq(hn::Load(tag, bundle.cells[axis].data() + first), hn::Set(tag, bundle.cell[axis]))) << first;
    }
    candidates &= same;
  }
  bundle.group = candidates;
}

void next_group(RayBundle& bundle) {
  select_cell_of(bundle, bundle.alive);
  if (bundle.group == bundle.alive) {
    return;
  }
  const Integers tag;
  alignas(64) Row<std::int32_t> way;
  auto least = hn::Set(tag, std::numeric_limits<std::int32_t>::max());
  for (std::size_t first = 0; first < bundle_rays_max; first += lanes_of<Integers>()) {
    const auto sum = hn::IfThenElse(mask_of(tag, bundle.alive >> first), progress(bundle, first),
                                    hn::Set(tag, std::numeric_limits<std::int32_t>::max()));
    hn::Store(sum, tag, way.data() + first);
    least = hn::Min(least, sum);
  }
  const auto nearest = hn::MinOfLanes(tag, least);
  RayMask candidates = 0;
  for (std::size_t first = 0; first < bundle_rays_max; first += lanes_of<Integers>()) {
    candidates |= bits_of(tag, hn::Eq(hn::Load(tag, way.data() + first), nearest)) << first;
  }
  select_cell_of(bundle, candidates & bundle.alive);
}

/// CellTraversal::exit_through() for the rays from `first` on; t_at(axis) is where they reach their plane of an axis.
template <class TAt>
HWY_INLINE hn::Vec<Doubles> exit_through(RayBundle& bundle, std::size_t first, const TAt& t_at) {
  const Doubles tag;
  auto exit = hn::Set(tag, never);
  std::array<RayMask, 3> through{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto t = t_at(axis);
    const auto is_nearer = hn::Lt(t, exit);
    through[axis] = bits_of(tag, is_nearer);
    exit = hn::IfThenElse(is_nearer, t, exit);
  }
  bundle.exit_axis[2] |= through[2] << first;
  bundle.exit_axis[1] |= (through[1] & ~through[2]) << first;
  bundle.exit_axis[0] |= (through[0] & ~(through[1] | through[2])) << first;
  hn::Store(exit, tag, bundle.t_exit.data() + first);
  return exit;
}

void find_exits(RayBundle& bundle, const PlanesAhead& ahead) {
  const Doubles tag;
  const HalfFloats half;
  bundle.exit_axis = {};
  for (std::size_t first = 0; first < bundle_rays_max; first += lanes_of<Doubles>()) {
    if ((bundle.group >> first & first_bits(lanes_of<Doubles>())) == 0) {
      continue;
    }
    const auto exit = exit_through(bundle, first, [&](std::size_t axis) {
      const auto slope = hn::Load(tag, bundle.slope[axis].data() + first);
      const auto index = hn::IfNegativeThenElse(slope, hn::Set(tag, static_cast<double>(ahead.below[axis])),
                                                hn::Set(tag, static_cast<double>(ahead.above[axis])));
      return hn::Add(hn::Mul(index, slope), hn::Load(tag, bundle.offset[axis].data() + first));
    });
    hn::Store(hn::DemoteTo(half, hn::Load(tag, bundle.t_enter.data() + first)), half, bundle.t_low.data() + first);
    hn::Store(hn::Min(hn::DemoteTo(half, exit), hn::Load(half, bundle.t_max.data() + first)), half, bundle.t_high.data() + first);
  }
}

void find_box_exits(RayBundle& bundle, RayMask rays, const PlaneRows& planes) {
  const Doubles tag;
  const HalfIntegers integers;
  bundle.exit_axis = {};
  for (std::size_t first = 0; first < bundle_rays_max; first += lanes_of<Doubles>()) {
    if ((rays >> first & first_bits(lanes_of<Doubles>())) == 0) {
      continue;
    }
    exit_through(bundle, first, [&](std::size_t axis) {
      const auto index = hn::PromoteTo(tag, hn::Load(integers, planes[axis].data() + first));
      return hn::Add(hn::Mul(index, hn::Load(tag, bundle.slope[axis].data() + first)),
                     hn::Load(tag, bundle.offset[axis].data() + first));
    });
  }
}

/// Those of `leaving` that do not end with a hit before their exit, or at a light; if both are equal, the next cell may hold a
/// hit at the same t with a lower id.
HWY_INLINE RayMask goes_on(const RayBundle& bundle, RayMask leaving) {
  const Doubles tag;
  const HalfFloats half;
  RayMask on = 0;
  for (std::size_t first = 0; first < bundle_rays_max; first += lanes_of<Doubles>()) {
    if ((leaving >> first & first_bits(lanes_of<Doubles>())) == 0) {
      continue;
    }
    const auto exit = hn::Load(tag, bundle.t_exit.data() + first);
    const auto best = hn::PromoteTo(tag, hn::Load(half, bundle.best.t.data() + first));
    const auto t_max = hn::PromoteTo(tag, hn::Load(half, bundle.t_max.data() + first));
    on |= bits_of(tag, hn::And(hn::Ge(best, exit), hn::Lt(exit, t_max))) << first;
  }
  return on & leaving;
}

/// Moves rays through a plane of `axis` to the cells behind it.
HWY_INLINE void cross(RayBundle& bundle, RayMask rays, std::size_t axis, std::int32_t cell, const Region* around) {
  const Doubles tag;
  const HalfIntegers integers;
  for (std::size_t first = 0; first < bundle_rays_max; first += lanes_of<Doubles>()) {
    const RayMask crossing = rays >> first & first_bits(lanes_of<Doubles>());
    if (crossing == 0) {
      continue;
    }
    hn::BlendedStore(hn::Set(integers, cell), mask_of(integers, crossing), integers, bundle.cells[axis].data() + first);
    const auto exit = hn::Load(tag, bundle.t_exit.data() + first);
    hn::BlendedStore(exit, mask_of(tag, crossing), tag, bundle.t_enter.data() + first);
    for (std::size_t other = 0; around != nullptr && other < 3; ++other) {
      if (other != axis) {
        locate_macro(bundle, other, first, crossing, exit, {around->low[other], around->high[other]}, axis);
      }
    }
  }
}

/// The number of macro cells that rays passed on the way, not counting one step for each ray.
std::uint64_t cells_passed(const RayBundle& bundle, RayMask rays) {
  std::uint64_t passed = 0;
  for (; rays != 0; rays &= rays - 1) {
    const auto ray = static_cast<std::size_t>(std::countr_zero(rays));
    std::int32_t between = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      between += std::abs(bundle.cells[axis][ray] - bundle.cell[axis]);
    }
    passed += static_cast<std::uint64_t>(std::max(between / finest_per_macro, 1) - 1);
  }
  return passed;
}

/// CellTraversal::leave().
std::uint64_t leave(RayBundle& bundle, RayMask leaving, const PlanesAhead& ahead, const Region* around) {
  const RayMask on = goes_on(bundle, leaving);
  RayMask entered = 0, kept = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const RayMask through = on & bundle.exit_axis[axis];
    const std::int32_t above = ahead.above[axis], below = ahead.below[axis] - 1;
    const RayMask up = above < bundle.grid_size[axis] ? through & bundle.forward[axis] : 0U;
    const RayMask down = below >= 0 ? through & ~bundle.forward[axis] : 0U;
    if (up != 0) {
      cross(bundle, up, axis, above & -finest_per_macro, around);
    }
    if (down != 0) {
      cross(bundle, down, axis, below & -finest_per_macro, around);
    }
    entered |= up | down;
    kept |= bundle.is_whole ? up | down : stay(bundle, up, axis, above) | stay(bundle, down, axis, below);
  }
  bundle.alive = (bundle.alive & ~leaving) | kept;
  return around != nullptr ? cells_passed(bundle, entered) : 0;
}

/// Moves rays through their planes of `axis` to the cells behind, within the grid; returns those of `rays` that it has moved.
HWY_INLINE RayMask cross_planes(RayBundle& bundle, RayMask rays, std::size_t axis, const Row<std::int32_t>& planes) {
  const Integers tag;
  RayMask crossing = 0;
  for (std::size_t first = 0; first < bundle_rays_max; first += lanes_of<Integers>()) {
    const auto plane = hn::Load(tag, planes.data() + first);
    const auto behind = hn::Sub(plane, hn::Set(tag, 1));
    const auto face = hn::IfThenElse(mask_of(tag, bundle.forward[axis] >> first), plane, behind);
    const auto is_in_grid = hn::And(hn::Gt(face, hn::Set(tag, -1)), hn::Lt(face, hn::Set(tag, bundle.grid_size[axis])));
    const RayMask here = rays >> first & bits_of(tag, is_in_grid);
    hn::BlendedStore(face, mask_of(tag, here), tag, bundle.arrival[axis].data() + first);
    crossing |= here << first;
  }
  return crossing;
}

RayMask pass_boxes(RayBundle& bundle, RayMask rays, const PlaneRows& planes) {
  const Doubles tag;
  const RayMask on = goes_on(bundle, rays);
  std::array<RayMask, 3> through;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    through[axis] = cross_planes(bundle, on & bundle.exit_axis[axis], axis, planes[axis]);
    set_entry(bundle, through[axis], axis);
  }
  const RayMask passed = through[0] | through[1] | through[2];
  for (std::size_t first = 0; first < bundle_rays_max; first += lanes_of<Doubles>()) {
    hn::BlendedStore(hn::Load(tag, bundle.t_exit.data() + first), mask_of(tag, passed >> first), tag,
                     bundle.t_enter.data() + first);
  }
  find_finest(bundle, 0, passed & ~through[0], through[1] | through[2]);
  find_finest(bundle, 1, passed & ~through[1], through[2]);
  find_finest(bundle, 2, passed & ~through[2], 0);
  return passed;
}

const BundleSteps* steps() {
  static constexpr BundleSteps all{enter, next_group, find_exits, leave, find_box_exits, pass_boxes};
  return &all;
}

}  // namespace dmpc::core::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace dmpc::core {
const BundleSteps* bundle_steps(std::size_t rank) {
  const auto compiled = DMPC_COMPILED_FOR(rank, steps);
  return compiled != nullptr ? compiled() : nullptr;
}

const BundleSteps& fastest_bundle_steps = *bundle_steps(0);

}  // namespace dmpc::core
#endif
