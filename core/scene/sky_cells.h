// A sky from a picture: what comes from a direction, and how hits aim at what is bright in it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/base/vec.h"
#include "core/record/record.h"
#include "core/record/sky.h"

namespace dmpc::core {

/// A cell of a tile, and where in it, from 0 to 1 to the right and downwards.
struct SkyPlace {
  std::uint32_t tile = 0;
  std::uint32_t column = 0, row = 0;  ///< in the tile
  double across = 0, down = 0;
};

/// Where a unit direction looks: who looks to the picture's middle, with its upper edge above, has its left half on his left.
SkyPlace sky_place(const SkyReference& sky, const Vec3d& direction);

/// What comes from there, and how densely hits aim there, per steradian.
struct SkyLight {
  Color radiance;
  double density = 0;
};
/// Between the texels around it bilinearly. `tile` is the record of the place's tile.
SkyLight sky_light(const SkyReference& sky, const std::byte* tile, const SkyPlace& place);

/// How likely the cells of a tile are drawn: each in proportion to its solid angle times the mean strength_of() its corners, and
/// a little more, so that none is never drawn. Anywhere in a cell is as likely by solid angle: so the density of a direction
/// follows from the texels around it, whoever asks. The host weighs tiles by all(), shading draws from one.
class SkyCells {
 public:
  SkyCells(const SkyReference& sky, std::uint32_t tile, const std::byte* record);

  /// The sum over all cells of solid angle times mean strength: without the little more, and with it.
  double strength() const { return strength_; }
  double solid_angle() const { return solid_angle_; }
  double all() const { return strength_ + solid_angle_ * least_; }

  struct Drawn {
    SkyPlace place;
    Vec3d towards;  ///< of unit length
  };
  /// For two numbers from 0 to less than 1 that are as likely anywhere.
  Drawn draw(double x, double y) const;

 private:
  double weight_of(std::uint32_t row) const { return row_[row].angle * (row_[row].strength + row_[row].count * least_); }

  /// A row of cells: where it begins and ends, as cosines of the angle from the upper pole.
  struct Row {
    double top = 1, bottom = 1;
    double angle = 0;     ///< the solid angle of a cell
    double strength = 0;  ///< the sum over its cells
    double count = 0;     ///< of them
  };

  const SkyReference& sky_;
  std::uint32_t tile_;
  double least_, strength_ = 0, solid_angle_ = 0;
  std::array<std::array<double, sky_tile_cells>, sky_tile_cells> cell_{};  ///< mean strengths
  std::array<Row, sky_tile_cells> row_{};
};

}  // namespace dmpc::core
