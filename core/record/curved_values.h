// Values of spheres and cones in records: centres and radii, a float each and the rest of its rounding, since mirrors multiply
// errors: a byte each, or more bits for radii of large surfaces that pass by local zero, where the detail of a scene lies then,
// and of cones as flat as discs.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/base/vec.h"
#include "core/record/record.h"

namespace dmpc::core {

/// A cone as thin as this share of its radius is flat: used as a disc or a ring.
inline constexpr double flat_cone_share = 0x1p-6;

/// A flat cone would have no axis if its two ends were rounded separately, so the rows of its apex hold the vector from the base,
/// and the signs of its radii differ.
inline bool is_flat_cone(float base_radius, float apex_radius) { return std::signbit(base_radius) != std::signbit(apex_radius); }
/// In either case the base's radius has a negative sign if the cone shows its inside only.
inline bool shows_inside_only(float base_radius) { return std::signbit(base_radius); }

/// A cone by its rows of a leaf: base, radius, apex, radius (core/record/record.h).
struct ConeFloats {
  explicit ConeFloats(const LeafLane& cone)
      : base(cone.vector(0)),
        is_flat(is_flat_cone(cone.rows[3 * cone.stride + cone.lane], cone.rows[7 * cone.stride + cone.lane])),
        axis(is_flat ? cone.vector(4) : cone.vector(4) - base),
        apex(is_flat ? base + axis : cone.vector(4)),
        base_radius(std::fabs(cone.value(3))),
        apex_radius(std::fabs(cone.value(7))) {}

  double widest() const { return std::max(base_radius, apex_radius); }
  /// The radius at a relative height between base and apex.
  double radius_at(double height) const { return base_radius + (apex_radius - base_radius) * height; }

  Vec3d base;
  bool is_flat;
  Vec3d axis, apex;                 ///< axis: from base to apex
  double base_radius, apex_radius;  ///< without their signs
};

/// In a scene of size about 1, a body with at least this radius is large.
inline constexpr float passing_radius_least = 0x1p-6F;
/// Its surface passes by local zero if its distance from there is below this share of its radius.
inline constexpr double passing_share = 0x1p-8;

/// Whether a surface of this radius passes by local zero; `distance_squared`: from there to its centre or axis.
inline bool passes_by(double distance_squared, double radius) {
  const double square = radius * radius;
  return std::fabs(distance_squared - square) <= 2 * passing_share * square;
}

inline bool sphere_passes_by(const LeafLane& sphere) {
  const Vec3d center = sphere.vector(0);
  return passes_by(dot(center, center), sphere.value(3));
}

/// Whether a radius, or the larger one of a cone, may be that of a large body.
inline bool is_large(float base_radius, float apex_radius) {
  return std::max(std::fabs(base_radius), std::fabs(apex_radius)) >= passing_radius_least;
}

/// A cone or cylinder about as wide as its distance, between its ends. The position of a long thin one is given by all bits of
/// both ends.
inline bool cone_passes_by(const ConeFloats& cone) {
  constexpr double widths_away_max = 8;
  const double widest = cone.widest();
  const double farthest = std::max(largest_component(cone.base), largest_component(cone.apex));
  if (cone.is_flat || !(farthest <= widths_away_max * widest)) {
    return false;
  }
  const double height = -dot(cone.base, cone.axis) / dot(cone.axis, cone.axis);
  const Vec3d across = cone.base + cone.axis * height;
  return height >= 0.0 && height <= 1.0 && passes_by(dot(across, across), cone.radius_at(height));
}

/// Whether a sphere or cone passes by local zero, by its floats alone. The position of such a surface there depends on few bits
/// of numbers as large as its radius. So its radius compensates for the rounding of its centre or ends, and gets more bits of the
/// rests. There is none in a scene whose grid begins at local zero.
inline bool passes_by_zero(PrimitiveKind kind, const LeafLane& curved) {
  const float* const values = curved.rows + curved.lane;
  if (kind == PrimitiveKind::sphere) {
    return is_large(values[3 * curved.stride], 0.0F) && sphere_passes_by(curved);
  }
  return is_large(values[3 * curved.stride], values[7 * curved.stride]) && cone_passes_by(ConeFloats(curved));
}

/// The rest of a value's rounding, in 256ths of a unit in the last place of its float: with it a value is exact to 2^-32, or,
/// halfway between two floats, to 2^-31. 0 if it is not finite.
inline std::int8_t rest_of(double value, float rounded) {
  const float power = std::bit_cast<float>(std::bit_cast<std::uint32_t>(rounded) & 0x7f800000U);
  const double rest = std::floor((value - double{rounded}) / (double{power} * 0x1p-31) + 0.5);
  return std::fabs(rest) <= 128.0 ? static_cast<std::int8_t>(std::min(rest, 127.0)) : std::int8_t{0};
}
inline double with_rest(float rounded, std::int8_t rest) {
  const float power = std::bit_cast<float>(std::bit_cast<std::uint32_t>(rounded) & 0x7f800000U);
  return double{rounded} + static_cast<double>(rest) * (double{power} * 0x1p-31);
}

/// Bits of the rests of a position and a radius that pass by local zero, in place of a byte each: those of the coordinates,
/// lowest first, then the radius. A value is exact to 2^-24 less its bits.
inline constexpr unsigned passing_place_bits = 4, passing_radius_bits = 32 - 3 * passing_place_bits;

/// The rest of rounding, in 2^-bits of a unit in the last place of its float.
inline std::int32_t rest_in_bits(double value, float rounded, unsigned bits) {
  const float power = std::bit_cast<float>(std::bit_cast<std::uint32_t>(rounded) & 0x7f800000U);
  const double most = static_cast<double>(std::uint32_t{1} << (bits - 1));
  const double rest = std::floor((value - double{rounded}) / (double{power} * 0x1p-24 / most) + 0.5);
  return std::fabs(rest) <= most ? static_cast<std::int32_t>(std::min(rest, most - 1)) : 0;
}
/// The value with its rest, which is in bits `first` to `first + bits - 1` of `word`.
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

/// One lane of a leaf of spheres or cones, each value with its rest: rows as LeafHeader says, `stride` floats each.
class CurvedValues {
 public:
  CurvedValues(PrimitiveKind kind, const float* rows, std::size_t stride, std::size_t lane)
      : rows_(rows + lane),
        rests_(rows_ + rest_row(kind) * stride),
        stride_(stride),
        passes_by_(passes_by_zero(kind, {rows, stride, lane})) {}

  /// A radius has its sign.
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
  /// The centre or base; the rows of a cone's apex.
  Vec3d vector(std::size_t row) const { return {value(row), value(row + 1), value(row + 2)}; }
  /// Whether most bits of the rests are those of radii: see passes_by_zero().
  bool passes_by() const { return passes_by_; }

  // For a cone only.
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

/// Whether a point is nearer to the surface than the possible rounding of that. `off_squared`: the square of its distance from
/// the centre or axis, minus that of the radius there; `size`: the largest coordinate and radius.
inline bool is_on_surface(const CurvedValues& curved, double off_squared, double radius, double size) {
  constexpr double moved = 0x1p-30, moved_passing = 0x1p-46;
  return std::fabs(off_squared) <= (curved.passes_by() ? moved_passing : moved) * size * std::fabs(radius);
}

}  // namespace dmpc::core
