// Hits of a bundle side by side: the geometry of triangles, and the mirrored and refracted rays of hits.
#pragma once

#include <array>
#include <cstddef>

#include "core/base/vec.h"
#include "core/picture/hits/hit_state.h"
#include "core/picture/hits/lanes.h"
#include "core/trace/bundle.h"

namespace dmpc::core {

/// Up to bundle_rays_max hits side by side, one row per value.
class TriangleLanes {
 public:
  /// Takes a hit whose geometry comes next, if it is on a triangle that shares its plane with none. `record`: its leaf, which
  /// stays until read_all(). Requires a free lane.
  bool take(HitState& state, const std::byte* record);
  /// Does what read_geometry() does, with the same bits, for all that were taken, and removes them.
  void read_all(VectorWidth width = vector_width());

 private:
  void find_lanes();

  std::size_t count_ = 0;
  std::array<HitState*, bundle_rays_max> state_;
  std::array<const std::byte*, bundle_rays_max> record_;
  VectorRows corner_, second_, third_, origin_, direction_;
  Row<double> t_;
  VectorRows point_, normal_;
  Row<double> u_, v_, clearance_;
};

/// Up to bundle_rays_max hits side by side, one row per value.
class ChildLanes {
 public:
  /// Adds a hit that sends such a ray; its relative_index() is read only for refraction. Requires a free lane.
  void add(const HitState& state, double index) {
    put(direction_, count_, state.ray.full_direction());
    put(normal_, count_, state.normal);
    starts_.put_hit(count_, state);
    index_[count_++] = index;
  }
  /// Computes the mirrored or refracted rays, which set_way() returns, with the bits of leave() for normalize() of
  /// mirrored_direction() or bent_direction(), and start_towards().
  void mirror(VectorWidth width = vector_width());
  void bend(VectorWidth width = vector_width());

  void set_way(std::size_t lane, Ray& child) const { rays_.set(lane, child); }

 private:
  void fill_up();
  template <bool is_bent>
  void send_lanes();

  std::size_t count_ = 0;
  VectorRows direction_, normal_;
  Row<double> index_;
  StartRows starts_;
  RayRows rays_;
};

}  // namespace dmpc::core
