// Centres and radii of spheres and cones, which mirrors multiply errors of: a float each, and a byte of what rounding left.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/base/vec.h"
#include "core/record/record.h"

namespace dmpc::core {

/// What rounding left of a value, in 256ths of a unit in the last place of its float: with it a value is exact to 2^-32, but
/// where it lies halfway between two floats, to 2^-31.
/// None of what is not finite.
inline std::int8_t rest_of(double value, float rounded) {
  const float power = std::bit_cast<float>(std::bit_cast<std::uint32_t>(rounded) & 0x7f800000U);
  const double rest = std::floor((value - double{rounded}) / (double{power} * 0x1p-31) + 0.5);
  return std::fabs(rest) <= 128.0 ? static_cast<std::int8_t>(std::min(rest, 127.0)) : std::int8_t{0};
}
inline double with_rest(float rounded, std::int8_t rest) {
  const float power = std::bit_cast<float>(std::bit_cast<std::uint32_t>(rounded) & 0x7f800000U);
  return double{rounded} + static_cast<double>(rest) * (double{power} * 0x1p-31);
}

/// One lane of a block of spheres or cones, each value with its rest: rows as BlockHeader says, `stride` floats each.
class CurvedValues {
 public:
  CurvedValues(PrimitiveKind kind, const float* rows, std::size_t stride, std::size_t lane)
      : rows_(rows + lane), rests_(rows_ + rest_row(kind) * stride), stride_(stride) {}

  double value(std::size_t row) const {
    const auto four = std::bit_cast<std::uint32_t>(rests_[row / 4 * stride_]);
    return with_rest(rows_[row * stride_], static_cast<std::int8_t>(four >> (row % 4 * 8) & 0xffU));
  }
  Vec3d vector(std::size_t row) const { return {value(row), value(row + 1), value(row + 2)}; }

 private:
  const float* rows_;
  const float* rests_;
  std::size_t stride_;
};

}  // namespace dmpc::core
