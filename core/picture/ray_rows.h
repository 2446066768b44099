// Rays that leave the hits of a bundle, side by side.
#pragma once

#include <cstddef>

#include "core/picture/lanes.h"
#include "core/record/ray.h"

namespace dmpc::core {

/// Where rays start, where they go and where they end: a row for each number, by lane.
class RayRows {
 public:
  /// For loops that compilers vectorise.
  void put(std::size_t lane, const Ray& ray) {
    core::put(origin_, lane, ray.origin);
    core::put(origin_rest_, lane, ray.origin_rest);
    core::put(direction_, lane, ray.direction);
    core::put(direction_rest_, lane, ray.direction_rest);
    t_max_[lane] = ray.t_max;
  }
  /// Sets of a ray what put() has taken of one.
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
