// Mount: a fractal mountain under four glass balls.
#include <cmath>
#include <cstdint>

#include "core/base/expect.h"
#include "core/base/sampling.h"
#include "core/families/families.h"
#include "core/families/frame.h"

namespace dmpc::core::scenes {
namespace {

/// The modulus, and the period, of the uniform random number generator that seeds are for.
constexpr std::uint32_t modulus = 134456;

/// A normally distributed number from a seed, without state (the polar method of Box, Muller and Marsaglia).
double gauss(std::uint32_t seed) {
  const auto next = [](std::uint32_t i) { return static_cast<std::uint32_t>((28411 + 8121 * std::uint64_t{i}) % modulus); };
  std::uint32_t second = seed;
  while (true) {
    const std::uint32_t first = next(second);
    second = next(first);
    const double x = 2 * (static_cast<double>(first) / modulus) - 1;
    const double y = 2 * (static_cast<double>(second) / modulus) - 1;
    const double square = x * x + y * y;
    if (square > 0 && square < 1) {
      return x * std::sqrt(-2 * natural_log(square) / square);
    }
  }
}

/// The hash of 1987 has a lattice of 2^7 cells a side; finer points are numbered on one of 2^16.
constexpr int first_bits = 7, finest_bits = 16;

/// The seed of a grid point's displacement; (x, y) are on the finest lattice. Points that a mountain of size 7 has keep the hash
/// of 1987, poor and repetitive as it is, so that results are comparable. That hash has no values between them: each of those
/// points has a seed of its own, mixed from both full coordinates. Seeds do not depend on the size, so each mountain has all
/// points of the smaller ones and more between.
std::uint32_t seed_of(std::uint32_t x, std::uint32_t y) {
  constexpr unsigned shift = finest_bits - first_bits;
  constexpr std::uint32_t between = (1U << shift) - 1;
  if (((x | y) & between) == 0) {
    return 21 + ((y >> shift) << 8U) + (x >> shift);
  }
  return static_cast<std::uint32_t>(mix((std::uint64_t{y} << 32U) | x) % modulus);
}

/// The corners of a square of the height field, counter-clockwise from the lower left.
struct Corners {
  double lower_left = 0, lower_right = 0, upper_right = 0, upper_left = 0;
};

class Mountain {
 public:
  Mountain(int size, SceneSink& sink) : size_(size), cells_(std::uint32_t{1} << static_cast<unsigned>(size)), sink_(sink) {
    expect(size >= 0 && size <= finest_bits, "a mountain's points lie on its finest lattice");
    constexpr double dimension = 2.2;
    const double quotient = 2 / exponential(natural_log(2) / (dimension - 1));
    roughness_ = std::sqrt(quotient * quotient - 1);
  }

  void add() { divide(cells_, 0, 0, {}); }

 private:
  /// The displacement of a grid point, for a step of 1.
  double displacement(std::uint32_t x, std::uint32_t y) const {
    const auto shift = static_cast<unsigned>(finest_bits - size_);
    return gauss(seed_of(x << shift, y << shift));
  }

  Vec3d grid_point(std::uint32_t x, std::uint32_t y, double height) const {
    return {-1 + 2.0 * x / cells_, -1 + 2.0 * y / cells_, height};
  }

  void add_cell(std::uint32_t x, std::uint32_t y, const Corners& c) {
    const Vec3d lower_left = grid_point(x, y, c.lower_left), lower_right = grid_point(x + 1, y, c.lower_right);
    const Vec3d upper_right = grid_point(x + 1, y + 1, c.upper_right), upper_left = grid_point(x, y + 1, c.upper_left);
    sink_.polygon({lower_left, lower_right, upper_right});
    sink_.polygon({upper_right, upper_left, lower_left});
  }

  void divide(std::uint32_t width, std::uint32_t x, std::uint32_t y, const Corners& c) {
    if (width == 1) {
      return add_cell(x, y, c);
    }
    const std::uint32_t half = width / 2;
    const double step = 2.0 * half / cells_ * roughness_;
    const double lower = (c.lower_left + c.lower_right) / 2 + step * displacement(x + half, y);
    const double right = (c.lower_right + c.upper_right) / 2 + step * displacement(x + width, y + half);
    const double upper = (c.upper_right + c.upper_left) / 2 + step * displacement(x + half, y + width);
    const double left = (c.upper_left + c.lower_left) / 2 + step * displacement(x, y + half);
    const double middle =
        (c.lower_left + c.lower_right + c.upper_right + c.upper_left) / 4 + 1.4142136 * step * displacement(x + half, y + half);
    divide(half, x, y, {c.lower_left, lower, middle, left});
    divide(half, x + half, y, {lower, c.lower_right, right, middle});
    divide(half, x + half, y + half, {middle, right, c.upper_right, upper});
    divide(half, x, y + half, {left, middle, upper, c.upper_left});
  }

  int size_;
  std::uint32_t cells_;
  SceneSink& sink_;
  double roughness_ = 0;
};

/// Four touching balls in a tetrahedron that stands on three of them.
void add_glass(SceneSink& sink) {
  const double radius = 0.17;
  const Vec3d center = {-0.8, 0.8, 1};
  const Vec3d top = {0, 0, radius * std::sqrt(1.5)};
  sink.material(
      {.color = {1, 1, 1}, .diffuse = 0.1, .specular = 0.1, .shine = 101.148, .transmittance = 0.9, .refraction_index = 1.5});
  sink.sphere(center + top, radius);
  const double d = 1 / std::sqrt(2.0);
  const Vec3d side = rotated(top, {d, d, 0}, {std::sqrt(8.0) / 3, -1.0 / 3});
  for (int k = 0; k < 3; ++k) {
    sink.sphere(center + rotation_z(turn_degrees(120.0 * k)).vector(side), radius);
  }
}

}  // namespace

void make_mount(int size, SceneSink& sink) {
  set_stage(sink, {.from = {-1.6, 1.6, 1.7}, .at = {0, 0, 0}, .up = {0, 0, 1}, .angle_degrees = 45, .hither = 0.01},
            {{-100, -100, 100}});
  add_glass(sink);
  sink.material({.color = {0.5, 0.45, 0.35}, .diffuse = 1, .specular = 0, .shine = no_highlight, .refraction_index = 0});
  Mountain(size, sink).add();
}

}  // namespace dmpc::core::scenes
