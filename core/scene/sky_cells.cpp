#include "core/scene/sky_cells.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/elementary.h"
#include "core/record/emitter.h"
#include "core/scene/texel.h"

namespace dmpc::core {
namespace {

using std::numbers::pi;

Color texel_of(const std::byte* tile, std::uint32_t column, std::uint32_t row) {
  return decoded(TexelFormat::shared_exponent, read<std::uint32_t>(tile + (row * tile_side + column) * sizeof(std::uint32_t)));
}

Vec3d left_of(const SkyReference& sky) { return cross(sky.up, sky.middle); }

template <class T>
T between(const T& first, const T& second, double place) {
  return first * (1 - place) + second * place;
}
/// Bilinear, of the values at the left and right corner above, then below.
template <class T>
T between(const std::array<T, 4>& corners, double across, double down) {
  return between(between(corners[0], corners[1], across), between(corners[2], corners[3], across), down);
}

/// Inverts the distribution whose density grows or falls linearly from `first` to `second`, relative to each other, on [0, 1].
double linear_place(double number, double first, double second) {
  const double place = number * (first + second) / (first + std::sqrt(between(first * first, second * second, number)));
  return std::clamp(place, 0.0, 1.0);
}

/// The angle from the upper pole at which a row of cells begins.
double angle_above(const SkyReference& sky, std::uint32_t row) {
  return pi * std::clamp(row - 0.5, 0.0, static_cast<double>(sky.height)) / sky.height;
}

/// The integer part, below `count`, and the fraction of a value in [0, count), which rounding may have moved out of the range.
struct Split {
  std::uint32_t cell;
  double rest;

  Split(double place, std::uint32_t count)
      : cell(std::min(static_cast<std::uint32_t>(std::max(place, 0.0)), count - 1)), rest(std::clamp(place - cell, 0.0, 1.0)) {}
};

}  // namespace

SkyPlace sky_place(const SkyReference& sky, const Vec3d& direction) {
  const double ahead = dot(direction, sky.middle), left = dot(direction, left_of(sky)), up = dot(direction, sky.up);
  const double turn = 0.5 - angle_of(left, ahead) / (2 * pi), across = turn * sky.width - 0.5;
  const Split column(across < 0 ? across + sky.width : across, sky.width);
  const double from_pole = angle_of(std::sqrt(ahead * ahead + left * left), up);
  const Split row(from_pole / pi * sky.height + 0.5, std::uint32_t{sky.height} + 1);
  return {row.cell / sky_tile_cells * sky_tile_columns(sky) + column.cell / sky_tile_cells,
          column.cell % sky_tile_cells,
          row.cell % sky_tile_cells,
          column.rest,
          row.rest,
          up};
}

SkyLight sky_light(const SkyReference& sky, const std::byte* tile, const SkyPlace& place) {
  const auto corner = [&](std::uint32_t right, std::uint32_t below) {
    return texel_of(tile, place.column + right, place.row + below);
  };
  const std::array<Color, 4> corners{corner(0, 0), corner(1, 0), corner(0, 1), corner(1, 1)};
  std::array<Vec3d, 4> light;
  std::array<double, 4> strength;
  std::transform(corners.begin(), corners.end(), light.begin(), [](const Color& color) { return Vec3d(color); });
  std::transform(corners.begin(), corners.end(), strength.begin(), [](const Color& color) { return strength_of(color); });
  const std::uint32_t row = place.tile / sky_tile_columns(sky) * sky_tile_cells + place.row;
  const double top = cos_radians(angle_above(sky, row)), bottom = cos_radians(angle_above(sky, row + 1));
  const double lowered = std::clamp((top - place.height) / (top - bottom), 0.0, 1.0);
  return {Color(between(light, place.across, place.down) * double{sky.scale}),
          double{sky.density} * (between(strength, place.across, lowered) + double{sky.least_strength})};
}

SkyCells::SkyCells(const SkyReference& sky, std::uint32_t tile, const std::byte* record)
    : sky_(sky), tile_(tile), least_(double{sky.least_strength}) {
  for (std::uint32_t row = 0; row < tile_side; ++row) {
    for (std::uint32_t column = 0; column < tile_side; ++column) {
      corner_[row][column] = sum_of_channels(read<std::uint32_t>(record + (row * tile_side + column) * sizeof(std::uint32_t)));
    }
  }
  const std::uint32_t columns = sky_tile_columns(sky), first_row = tile / columns * sky_tile_cells,
                      first_column = tile % columns * sky_tile_cells;
  const std::uint32_t rows = std::min(sky_tile_cells, sky.height + 1 - first_row);
  const std::uint32_t cells = std::min(sky_tile_cells, sky.width - first_column);
  double above = cos_radians(angle_above(sky, first_row));
  for (std::uint32_t row = 0; row < rows; ++row) {
    const double below = cos_radians(angle_above(sky, first_row + row + 1));
    Row& its = row_[row];
    its.top = above;
    its.bottom = below;
    its.angle = 2 * pi / sky.width * (above - below);
    its.count = cells;
    for (std::uint32_t cell = 0; cell < cells; ++cell) {
      its.strength += mean_at(row, cell);
    }
    strength_ += its.strength * its.angle;
    solid_angle_ += its.count * its.angle;
    above = below;
  }
}

double SkyCells::mean_at(std::uint32_t row, std::uint32_t cell) const {
  return ((corner_[row][cell] + corner_[row][cell + 1]) + (corner_[row + 1][cell] + corner_[row + 1][cell + 1])) * 0.25;
}

SkyCells::Drawn SkyCells::draw(double x, double y) const {
  double left = x * all();
  std::uint32_t row = 0;
  for (; row + 1 < sky_tile_cells && row_[row + 1].count > 0 && left >= weight_of(row); ++row) {
    left -= weight_of(row);
  }
  const Row& its = row_[row];
  left /= its.angle;
  std::uint32_t cell = 0;
  for (; cell + 1 < static_cast<std::uint32_t>(its.count) && left >= mean_at(row, cell) + least_; ++cell) {
    left -= mean_at(row, cell) + least_;
  }
  const auto corner = [&](std::uint32_t right, std::uint32_t below) { return corner_[row + below][cell + right] + least_; };
  const double across = linear_place(std::clamp(left / (mean_at(row, cell) + least_), 0.0, 1.0), corner(0, 0) + corner(0, 1),
                                     corner(1, 0) + corner(1, 1));
  const double lowered =
      linear_place(y, between(corner(0, 0), corner(1, 0), across), between(corner(0, 1), corner(1, 1), across));
  const std::uint32_t columns = sky_tile_columns(sky_);
  const double turn = (tile_ % columns * sky_tile_cells + cell + across + 0.5) / sky_.width, angle = 2 * pi * (0.5 - turn);
  const double height = its.top + lowered * (its.bottom - its.top), out = std::sqrt(std::max(0.0, 1 - height * height));
  const double from_macro = angle_of(out, height) / pi * sky_.height + 0.5 - (tile_ / columns * sky_tile_cells + row);
  return {{tile_, cell, row, across, std::clamp(from_macro, 0.0, 1.0), height},
          sky_.up * height + (sky_.middle * cos_radians(angle) + left_of(sky_) * sin_radians(angle)) * out};
}

}  // namespace dmpc::core
