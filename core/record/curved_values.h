// Values of spheres and cones as records hold them: centres and radii, which mirrors multiply errors of, a float each, and what
// rounding left: a byte each, or more of it for radii. Of large surfaces that pass by local zero, where the detail of a scene
// lies then, and of cones as flat as discs.
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

/// Of a flat cone rounding the two ends apart would leave no axis, so the rows of its apex hold the way there from the base, and
/// the signs of its radii differ.
inline bool is_flat_cone(float base_radius, float apex_radius) { return std::signbit(base_radius) != std::signbit(apex_radius); }
/// Either way the base's radius has a negative sign if the cone shows its inside only.
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
  /// At a share of the way from base to apex.
  double radius_at(double height) const { return base_radius + (apex_radius - base_radius) * height; }

  Vec3d base;
  bool is_flat;
  Vec3d axis, apex;                 ///< axis: from base to apex
  double base_radius, apex_radius;  ///< without their signs
};

/// From this radius on, beside a scene of about 1, a body is large.
inline constexpr float passing_radius_least = 0x1p-6F;
/// Its surface passes by local zero if it comes nearer to it than this share of its radius.
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

/// A cone or cylinder that is about as wide as it is far away, between its ends. One that is long beside its radius has its
/// place across it by all of its ends' bits.
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

/// Whether a sphere or cone passes by local zero, by its floats alone. The place of such a surface there hangs on few bits of
/// numbers that are as large as its radius. So its radius makes good what rounding moved its centre, or its ends, by, and has
/// more of the rests than they (core/record/curved_values.h). In a scene whose grid begins at local zero there is none.
inline bool passes_by_zero(PrimitiveKind kind, const LeafLane& curved) {
  const float* const values = curved.rows + curved.lane;
  if (kind == PrimitiveKind::sphere) {
    return is_large(values[3 * curved.stride], 0.0F) && sphere_passes_by(curved);
  }
  return is_large(values[3 * curved.stride], values[7 * curved.stride]) && cone_passes_by(ConeFloats(curved));
}

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

/// The rests of a place and a radius that pass by local zero (core/record/curved_values.h): of each coordinate this many bits
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

/// One lane of a leaf of spheres or cones, each value with its rest: rows as LeafHeader says, `stride` floats each.
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
