#include "apps/formats/landscape/terrain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/base/sampling.h"

namespace dmpc::apps {

namespace {

using core::Vec3d;

constexpr int octaves = 10;

/// Coordinates are shifted by this before they are truncated to integers, because truncation rounds down only above 0.
constexpr double lattice_shift = 4096;

/// One of eight directions that belongs to a point of the lattice, times the way from there.
double slope_at(std::int64_t column, std::int64_t row, std::uint64_t seed, double x, double z) {
  static constexpr std::array<std::array<double, 2>, 8> directions = {
      {{1, 0.5}, {-1, 0.5}, {1, -0.5}, {-1, -0.5}, {0.5, 1}, {-0.5, 1}, {0.5, -1}, {-0.5, -1}}};
  const std::uint64_t hash = core::mix(core::mix(seed + static_cast<std::uint64_t>(column)) + static_cast<std::uint64_t>(row));
  const auto& direction = directions[hash & 7U];
  return direction[0] * x + direction[1] * z;
}

double fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }
double blend(double a, double b, double share) { return a + (b - a) * share; }

/// From -1 to 1.
double noise(double x, double z, std::uint64_t seed) {
  const auto column = static_cast<std::int64_t>(x + lattice_shift), row = static_cast<std::int64_t>(z + lattice_shift);
  const double s = x + lattice_shift - static_cast<double>(column), t = z + lattice_shift - static_cast<double>(row);
  const double top = blend(slope_at(column, row, seed, s, t), slope_at(column + 1, row, seed, s - 1, t), fade(s));
  const double bottom =
      blend(slope_at(column, row + 1, seed, s, t - 1), slope_at(column + 1, row + 1, seed, s - 1, t - 1), fade(s));
  return blend(top, bottom, fade(t));
}

/// 0 below `low`, 1 above `high`, and smooth between.
double step_between(double low, double high, double value) {
  const double share = std::clamp((value - low) / (high - low), 0.0, 1.0);
  return share * share * (3 - 2 * share);
}

/// From 0 to about 1: sharp ridges, rougher where it is high.
double ridges(double x, double z) {
  double sum = 0, weight = 1, amplitude = 0.5, frequency = 2.25;
  for (std::uint64_t octave = 0; octave < octaves; ++octave) {
    const double ridge = 1 - std::abs(noise(x * frequency, z * frequency, octave << 32U));
    const double height = ridge * ridge * weight;
    sum += height * amplitude;
    weight = std::clamp(2 * height, 0.0, 1.0);
    amplitude *= 0.5;
    frequency *= 2;
  }
  return sum;
}

Vec3d blend(const Vec3d& a, const Vec3d& b, double share) { return a + (b - a) * share; }

}  // namespace

double ground_height(double x, double z) {
  const double across = x + 0.1, along = z - 0.34;
  const double basin = step_between(0, 0.75, across * across + 4 * along * along);
  return basin * 0.42 * ridges(x, z);
}

Vec3d ground_normal(double x, double z, double step) {
  const double across = ground_height(x - step, z) - ground_height(x + step, z);
  const double along = ground_height(x, z - step) - ground_height(x, z + step);
  return core::normalize(Vec3d{across, 2 * step, along});
}

Vec3d ground_color(double x, double z, double height, double upright) {
  constexpr Vec3d sand{0.55, 0.45, 0.28}, grass{0.10, 0.22, 0.04}, meadow{0.24, 0.26, 0.08}, rock{0.22, 0.19, 0.17},
      snow{0.9, 0.92, 0.96};
  const double patches = noise(x * 12, z * 12, 77), grain = noise(x * 300, z * 300, 78) + noise(x * 900, z * 900, 79);
  const double ragged = height + 0.02 * patches + 0.006 * grain;
  Vec3d color = blend(grass, meadow, step_between(-0.4, 0.4, patches + 0.3 * grain));
  color = blend(sand, color, step_between(lake_height + 0.004, lake_height + 0.02, ragged));
  color = blend(color, rock, step_between(0.14, 0.22, ragged));
  color = blend(rock, color, step_between(0.55, 0.72, upright));
  color = blend(color, snow, step_between(0.24, 0.28, ragged) * step_between(0.45, 0.6, upright));
  return color * std::clamp(0.9 + 0.1 * grain, 0.6, 1.05);
}

}  // namespace dmpc::apps
