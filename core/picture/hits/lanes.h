// Values of a bundle's hits side by side, for loops that compilers vectorise. Their bodies have no branches, each is compiled for
// each width of vectors, and CMakeLists.txt allows compilers to compute what a selection then discards.
#pragma once

#include <cstddef>

#include "core/base/vec.h"
#include "core/base/vector_width.h"
#include "core/picture/hits/hit_state.h"
#include "core/record/ray.h"
#include "core/trace/bundle.h"

namespace dmpc::core {

/// Rows of vectors, by component.
template <class T>
struct RowsOf {
  Row<T> x, y, z;
};
using VectorRows = RowsOf<double>;

template <class T>
void put(RowsOf<T>& rows, std::size_t lane, const Vec3<T>& v) {
  rows.x[lane] = v.x;
  rows.y[lane] = v.y;
  rows.z[lane] = v.z;
}

template <class T>
Vec3<T> get(const RowsOf<T>& rows, std::size_t lane) {
  return {rows.x[lane], rows.y[lane], rows.z[lane]};
}

/// Doubles in the widest vector. Loops over lanes go by groups of this many: unused lanes of the last group hold a copy of the
/// first lane, by fill_up(), and are computed in vain.
inline constexpr std::size_t group_lanes = 8;

/// Copies the first of `count` lanes to those behind them, up to a whole group, so that no uninitialised value is used.
inline void fill_up(Row<double>& row, std::size_t count) {
  for (; count % group_lanes != 0; ++count) {
    row[count] = row[0];
  }
}
inline void fill_up(VectorRows& rows, std::size_t count) {
  fill_up(rows.x, count);
  fill_up(rows.y, count);
  fill_up(rows.z, count);
}

/// The inputs of start_towards() and leave(), one row per value, by lane.
class StartRows {
 public:
  void put_hit(std::size_t lane, const HitState& state) {
    put(point_, lane, state.point);
    put(true_normal_, lane, state.geometric_normal);
    along_[lane] = state.clearance.along;
    across_[lane] = state.clearance.across;
    radius_[lane] = state.clearance.radius;
  }
  /// See lanes.h.
  void fill_up(std::size_t count) {
    core::fill_up(point_, count);
    core::fill_up(true_normal_, count);
    core::fill_up(along_, count);
    core::fill_up(across_, count);
    core::fill_up(radius_, count);
  }
  Vec3d point(std::size_t lane) const { return get(point_, lane); }
  Vec3d true_normal(std::size_t lane) const { return get(true_normal_, lane); }
  Clearance clearance(std::size_t lane) const { return {along_[lane], across_[lane], radius_[lane]}; }

 private:
  VectorRows point_, true_normal_;
  Row<double> along_, across_, radius_;
};

/// Rays' starts, directions and ends, one row per value, by lane.
class RayRows {
 public:
  /// In a form that compilers vectorise.
  void put(std::size_t lane, const Ray& ray) {
    core::put(origin_, lane, ray.origin);
    core::put(origin_rest_, lane, ray.origin_rest);
    core::put(direction_, lane, ray.direction);
    core::put(direction_rest_, lane, ray.direction_rest);
    t_max_[lane] = ray.t_max;
  }
  /// Sets the members of a ray that put() takes.
  void set(std::size_t lane, Ray& ray) const {
    ray.origin = get(origin_, lane);
    ray.origin_rest = get(origin_rest_, lane);
    ray.direction = get(direction_, lane);
    ray.direction_rest = get(direction_rest_, lane);
    ray.t_max = t_max_[lane];
  }

 private:
  RowsOf<float> origin_, origin_rest_, direction_, direction_rest_;
  Row<float> t_max_;
};

}  // namespace dmpc::core
