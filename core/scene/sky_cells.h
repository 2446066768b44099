// A sky from a picture: its radiance by direction, and light sampling of it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/base/vec.h"
#include "core/record/record.h"
#include "core/record/sky.h"

namespace dmpc::core {

/// A cell of a tile, and the position in it, from 0 to 1 to the right and downwards.
struct SkyPlace {
  std::uint32_t tile = 0;
  std::uint32_t column = 0, row = 0;  ///< in the tile
  double across = 0, down = 0;
  double height = 1;  ///< cosine of the angle from the upper pole
};

/// The place that a unit direction sees: looking at the picture's middle, with its upper edge above, its left half is on the
/// left.
SkyPlace sky_place(const SkyReference& sky, const Vec3d& direction);

/// The radiance from there, and the density of light sampling, per steradian.
struct SkyLight {
  Color radiance;
  double density = 0;
};
/// Bilinear interpolation of the texels around it; the density interpolates across and by height. `tile` is the record of the
/// place's tile.
SkyLight sky_light(const SkyReference& sky, const std::byte* tile, const SkyPlace& place);

/// Sampling of the cells of a tile: in proportion to the solid angle times the mean strength_of() of the corners, plus a minimum,
/// so that no cell is never drawn. Within a cell the density is bilinear between its corners, across and by height, as solid
/// angles are (M. Pharr, W. Jakob, G. Humphreys, "Physically Based Rendering", 4th edition, 2023, A.5): so the density of a
/// direction follows from the texels around it, on any node, and a sun of a few texels is sampled as it shines. The host weights
/// tiles by all(), shading samples one.
class SkyCells {
 public:
  SkyCells(const SkyReference& sky, std::uint32_t tile, const std::byte* record);

  /// The sum over all cells of solid angle times mean strength: without the minimum, and with it.
  double strength() const { return strength_; }
  double solid_angle() const { return solid_angle_; }
  double all() const { return strength_ + solid_angle_ * least_; }

  struct Drawn {
    SkyPlace place;
    Vec3d towards;  ///< unit length
  };
  /// For two uniform numbers in [0, 1).
  Drawn draw(double x, double y) const;

 private:
  /// The mean strength of a cell's corners.
  double mean_at(std::uint32_t row, std::uint32_t cell) const;
  double weight_of(std::uint32_t row) const { return row_[row].angle * (row_[row].strength + row_[row].count * least_); }

  /// A row of cells: its limits, as cosines of the angle from the upper pole.
  struct Row {
    double top = 1, bottom = 1;
    double angle = 0;     ///< the solid angle of a cell
    double strength = 0;  ///< the sum over its cells
    double count = 0;     ///< number of its cells
  };

  const SkyReference& sky_;
  std::uint32_t tile_;
  double least_, strength_ = 0, solid_angle_ = 0;
  std::array<std::array<double, tile_side>, tile_side> corner_;  ///< strengths of texels
  std::array<Row, sky_tile_cells> row_{};
};

}  // namespace dmpc::core
