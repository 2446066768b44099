// Centres and radii of spheres and cones, which mirrors multiply errors of: a float each, and what rounding left: a byte each, or
// more of it for radii.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/base/vec.h"
#include "core/record/block_lane.h"
#include "core/record/passing_surface.h"
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

/// The rests of a place and a radius that pass by local zero (core/record/passing_surface.h): of each coordinate this many bits
/// in place of a byte, lowest first, and of the radius the others. A value is exact to 2^-24 less its bits.
inline constexpr unsigned passing_place_bits = 4, passing_radius_bits = 32 - 3 * passing_place_bits;

/// What rounding left, in 2^-bits of a unit in the last place of its float.
inline std::int32_t rest_in_bits(double value, float rounded, unsigned bits) {
  const float power = std::bit_cast<float>(std::bit_cast<std::uint32_t>(rounded) & 0x7f800000U);
  const double most = static_cast<double>(std::uint32_t{1} << (bits - 1));
  const double rest = std::floor((value - double{rounded}) / (double{power} * 0x1p-24 / most) + 0.5);
  return std::fabs(rest) <= most ? static_cast<std::int32_t>(std::min(rest, most - 1)) : 0;
}
/// `word` has the rest in so many bits from `first` on.
inline double with_rest_in_bits(float rounded, std::uint32_t word, unsigned first, unsigned bits) {
  const float power = std::bit_cast<float>(std::bit_cast<std::uint32_t>(rounded) & 0x7f800000U);
  const std::int32_t rest = static_cast<std::int32_t>(word << (32 - first - bits)) >> (32 - bits);
  return double{rounded} +
         static_cast<double>(rest) * (double{power} * 0x1p-24 / static_cast<double>(std::uint32_t{1} << (bits - 1)));
}
/// Number `place` of four values: three coordinates, then the radius.
inline double with_passing_rest(float rounded, std::uint32_t word, std::size_t place) {
  const auto first = static_cast<unsigned>(place) * passing_place_bits;
  return with_rest_in_bits(rounded, word, first, place < 3 ? passing_place_bits : passing_radius_bits);
}
/// The word of the rests of four values, which have been rounded.
inline std::uint32_t passing_rests_of(const std::array<double, 4>& values, const float* rounded) {
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const unsigned bits = i < 3 ? passing_place_bits : passing_radius_bits;
    const auto rest = static_cast<std::uint32_t>(rest_in_bits(values[i], rounded[i], bits));
    word |= (rest & ((std::uint32_t{1} << bits) - 1)) << (i * passing_place_bits);
  }
  return word;
}

/// A sphere, or an end of a cone; the radius has its sign.
struct PlaceAndRadius {
  Vec3d place;
  double radius;
};

/// One lane of a block of spheres or cones, each value with its rest: rows as BlockHeader says, `stride` floats each.
class CurvedValues {
 public:
  CurvedValues(PrimitiveKind kind, const float* rows, std::size_t stride, std::size_t lane)
      : rows_(rows + lane),
        rests_(rows_ + rest_row(kind) * stride),
        stride_(stride),
        passes_by_(passes_by_zero(kind, {rows, stride, lane})) {}

  /// That of a radius has its sign.
  double value(std::size_t row) const {
    const float rounded = rows_[row * stride_];
    const auto four = std::bit_cast<std::uint32_t>(rests_[row / 4 * stride_]);
    if (passes_by_) [[unlikely]] {
      return with_passing_rest(rounded, four, row % 4);
    }
    return with_rest(rounded, static_cast<std::int8_t>(four >> (row % 4 * 8) & 0xffU));
  }
  /// The four values from `first` on, 0 or 4, at once.
  PlaceAndRadius four(std::size_t first) const {
    const float* const row = rows_ + first * stride_;
    const float x = row[0], y = row[stride_], z = row[2 * stride_], radius = row[3 * stride_];
    const auto rests = std::bit_cast<std::uint32_t>(rests_[first / 4 * stride_]);
    if (passes_by_) [[unlikely]] {
      return {{with_passing_rest(x, rests, 0), with_passing_rest(y, rests, 1), with_passing_rest(z, rests, 2)},
              with_passing_rest(radius, rests, 3)};
    }
    const auto with = [&](float rounded, unsigned shift) {
      return with_rest(rounded, static_cast<std::int8_t>(rests >> shift & 0xffU));
    };
    return {{with(x, 0), with(y, 8), with(z, 16)}, with(radius, 24)};
  }
  /// The centre, the base, and of a cone's apex what its rows say.
  Vec3d vector(std::size_t row) const { return {value(row), value(row + 1), value(row + 2)}; }
  /// Whether most of the rests is that of radii: see passes_by_zero().
  bool passes_by() const { return passes_by_; }

  // Of a cone alone.
  bool is_flat() const { return is_flat_cone(rows_[3 * stride_], rows_[7 * stride_]); }
  bool is_inside_visible_only() const { return shows_inside_only(rows_[3 * stride_]); }
  /// From the base to the apex.
  Vec3d axis() const { return is_flat() ? vector(4) : vector(4) - vector(0); }
  Vec3d apex() const { return is_flat() ? vector(0) + vector(4) : vector(4); }

 private:
  const float* rows_;
  const float* rests_;
  std::size_t stride_;
  bool passes_by_;
};

/// Whether it is nearer to the surface than rounding may have moved that. `off_squared`: the square of its distance from the
/// centre or axis, less that of the radius there; `size`: the largest coordinate and radius.
inline bool is_on_surface(const CurvedValues& curved, double off_squared, double radius, double size) {
  constexpr double moved = 0x1p-30, moved_passing = 0x1p-46;
  return std::fabs(off_squared) <= (curved.passes_by() ? moved_passing : moved) * size * std::fabs(radius);
}

}  // namespace dmpc::core
