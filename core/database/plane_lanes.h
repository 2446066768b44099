// The places of many planes, found side by side.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/vector_width.h"
#include "core/database/face.h"
#include "core/database/plane_place.h"

namespace dmpc::core {

/// Places of a few faces' planes, for each axis that they are seen along.
class PlaneLanes {
 public:
  static constexpr std::size_t count_max = 16;

  PlaneLanes(const BucketSize& size, const Surroundings& around, VectorWidth width = vector_width())
      : size_(size), around_(around), width_(width) {}

  /// Of 1 to count_max faces, none of them degenerate.
  void find(std::span<const Face> faces);
  bool is_seen(std::size_t lane, std::size_t axis) const { return seen_[axis][lane] != 0; }
  /// Where it is seen.
  PlanePlace place(std::size_t lane, std::size_t axis) const {
    const auto range = [&](std::size_t dimension) {
      return BucketRange{first_[axis][dimension][lane], last_[axis][dimension][lane]};
    };
    return {range(0), range(1), range(2)};
  }

 private:
  template <class T>
  using Row = std::array<T, count_max>;

  template <std::size_t axis>
  void find_along();

  BucketSize size_;
  Surroundings around_;
  VectorWidth width_;
  alignas(64) std::array<Row<double>, 3> normal_{}, corner_{};
  Row<double> moved_{}, altitude_{}, tilted_{}, rounded_{};
  std::array<Row<std::int32_t>, 3> seen_{};
  std::array<std::array<Row<std::int32_t>, 3>, 3> first_{}, last_{};  ///< by axis and dimension
};

}  // namespace dmpc::core
