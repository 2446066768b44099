#include "core/trace/curved_lanes.h"

#include <algorithm>
#include <array>
#include <bit>

#include "core/trace/curved_solve.h"
#include "core/trace/primitive.h"

namespace dmpc::core {
namespace {

/// Pairs of a ray and a primitive that are solved together, at most, and in one vector.
constexpr std::size_t pairs_max = 16, vector_pairs = 4;

using PairRow = std::array<double, pairs_max>;
struct PairRows {
  PairRow x, y, z;

  void put(std::size_t pair, const Vec3d& v) {
    x[pair] = v.x;
    y[pair] = v.y;
    z[pair] = v.z;
  }
  Vec3d get(std::size_t pair) const { return {x[pair], y[pair], z[pair]}; }
};

/// A primitive of the leaf, in double. Those that are seldom met are solved one by one.
struct Primitive {
  ConeValues values;
  bool is_rare;
};

class CurvedPairs {
 public:
  CurvedPairs(RayBundle& bundle, const CurvedRows& curved, const std::uint32_t* ids, Address leaf, VectorWidth width)
      : bundle_(bundle), curved_(curved), ids_(ids), leaf_(leaf), width_(width) {}

  void add(std::size_t ray, std::size_t lane) {
    const Primitive& primitive = read(lane);
    const bool is_cone = curved_.kind == PrimitiveKind::cone;
    if (primitive.is_rare) {
      return take(ray, lane, alone(ray, lane));
    }
    origin_.put(count_, bundle_.rays[ray].full_origin());
    direction_.put(count_, bundle_.rays[ray].full_direction());
    base_.put(count_, primitive.values.base);
    base_radius_[count_] = primitive.values.base_radius;
    if (is_cone) {
      axis_.put(count_, primitive.values.axis);
      apex_radius_[count_] = primitive.values.apex_radius;
    }
    rays_[count_] = static_cast<std::uint8_t>(ray);
    lanes_[count_] = static_cast<std::uint8_t>(lane);
    if (++count_ == pairs_max) {
      solve();
    }
  }

  void solve() {
    const std::size_t count = fill_up();
    run_by(width_, [this, count] { curved_.kind == PrimitiveKind::cone ? solve_cones(count) : solve_spheres(count); });
    for (std::size_t pair = 0; pair < count_; ++pair) {
      const std::size_t ray = rays_[pair], lane = lanes_[pair];
      const bool may_start_there = bundle_.rays[ray].kind == RayKind::primary && near_[pair] < next_to_start;
      take(ray, lane, may_start_there ? alone(ray, lane) : static_cast<float>(t_[pair]));
    }
    count_ = 0;
  }

 private:
  const Primitive& read(std::size_t lane) {
    Primitive& primitive = primitives_[lane];
    if ((read_ >> lane & 1U) == 0) {
      read_ |= 1U << lane;
      const CurvedValues values(curved_.kind, curved_.rows, curved_.count, lane);
      if (curved_.kind == PrimitiveKind::cone) {
        primitive = {cone_values(values), values.is_flat() || values.is_inside_visible_only()};
      } else {
        const auto [center, radius] = values.four(0);
        primitive = {{center, {}, radius, 0}, false};
      }
    }
    return primitive;
  }

  /// Copies the first pair to those behind the last, up to a whole vector, so that no uninitialised value is used.
  /// Returns how many there are then.
  std::size_t fill_up() {
    const std::size_t count = (count_ + vector_pairs - 1) / vector_pairs * vector_pairs;
    for (std::size_t pair = count_; pair < count; ++pair) {
      origin_.put(pair, origin_.get(0));
      direction_.put(pair, direction_.get(0));
      base_.put(pair, base_.get(0));
      axis_.put(pair, axis_.get(0));
      base_radius_[pair] = base_radius_[0];
      apex_radius_[pair] = apex_radius_[0];
    }
    return count;
  }

  [[gnu::always_inline]] void solve_spheres(std::size_t count) {
    for (std::size_t pair = 0; pair < count; ++pair) {
      const SphereLine line(base_.get(pair), base_radius_[pair], origin_.get(pair), direction_.get(pair));
      t_[pair] = line.nearest_visible();
      near_[pair] = line.crossings.nearest_to_start(0);
    }
  }
  [[gnu::always_inline]] void solve_cones(std::size_t count) {
    for (std::size_t pair = 0; pair < count; ++pair) {
      const ConeLine line({base_.get(pair), axis_.get(pair), base_radius_[pair], apex_radius_[pair]}, false, origin_.get(pair),
                          direction_.get(pair));
      t_[pair] = line.nearest_visible(false);
      near_[pair] = line.roots.nearest_to_start(line.shift);
    }
  }

  float alone(std::size_t ray, std::size_t lane) const {
    const auto intersect = curved_.kind == PrimitiveKind::cone ? intersect_cone : intersect_sphere;
    return intersect(bundle_.rays[ray], curved_.rows, curved_.count, lane);
  }

  void take(std::size_t ray, std::size_t lane, float t) {
    const Hit hit{t, ids_[lane], leaf_, static_cast<std::uint32_t>(lane)};
    if (t > 0.0F && t < bundle_.t_max[ray] && hit.primitive != bundle_.ignored_primitive[ray] &&
        nearer(t, hit.primitive, bundle_.best.of(ray))) {
      bundle_.best.set(ray, hit);
      bundle_.found |= RayMask{1} << ray;
    }
  }

  RayBundle& bundle_;
  const CurvedRows& curved_;
  const std::uint32_t* ids_;
  Address leaf_;
  VectorWidth width_;
  std::size_t count_ = 0;
  std::uint32_t read_ = 0;
  std::array<Primitive, leaf_lanes> primitives_;
  std::array<std::uint8_t, pairs_max> rays_, lanes_;
  alignas(64) PairRows origin_, direction_, base_, axis_;
  PairRow base_radius_, apex_radius_, t_, near_;
};

}  // namespace

void hit_curved(RayBundle& bundle, const std::byte* record, Address leaf, RayMask rays, CurvedReach reach, VectorWidth width) {
  const auto header = read<LeafHeader>(record);
  const CurvedRows curved{header.kind, reinterpret_cast<const float*>(record + sizeof(LeafHeader)), header.count};
  Row<float> t_most;
  for (std::size_t ray = 0; ray < bundle_rays_max; ++ray) {
    t_most[ray] = std::min(bundle.best.t[ray], bundle.t_max[ray]);
  }
  Row<RayMask> reached;
  rays = reach(curved, bundle.rays.data(), rays, t_most.data(), reached.data());
  if (rays == 0) {
    return;
  }
  CurvedPairs pairs(bundle, curved, reinterpret_cast<const std::uint32_t*>(ids_of(header, record)), leaf, width);
  for (; rays != 0; rays &= rays - 1) {
    const auto ray = static_cast<std::size_t>(std::countr_zero(rays));
    for (RayMask lanes = reached[ray]; lanes != 0; lanes &= lanes - 1) {
      pairs.add(ray, static_cast<std::size_t>(std::countr_zero(lanes)));
    }
  }
  pairs.solve();
}

}  // namespace dmpc::core
