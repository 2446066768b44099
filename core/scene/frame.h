// The grid's place in the world and its resolution.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/base/box.h"
#include "core/record/record.h"
#include "core/scene/scene.h"

namespace dmpc::core {

/// A frame for `primitive_count` primitives within `bounds`, with about `cells_per_primitive` cubic cells each. The grid starts a
/// fixed odd share of a cell outside the bounds, so that regular scenes do not have all their vertices on corners of cells; flat
/// scenes get a thickness of 1e-4 of their largest extent, and no scene is thinner than 2^-36 of its largest coordinate, the
/// limit of doubles' resolution. Bounds scaled by a power of two give the same frame, scaled, to the last bit.
GridFrame fit_frame(const Box& bounds, std::size_t primitive_count, double cells_per_primitive);

/// Makes a place local zero. The grid does not move.
inline void move_zero(GridFrame& frame, const Vec3d& place) {
  frame.low = frame.low + (frame.origin - place) * frame.scale;
  frame.origin = place;
}

/// An eye is far if it is more than this many of the grid's diagonals from the grid's middle: its rays start within a diagonal of
/// the grid, so that floats need not hold the distance.
inline constexpr double far_eye_diagonals = 4;

/// The distance of an eye from the middle of the scene's bounds, in multiples of its extent; 2 * far_eye_diagonals stands for
/// more, too. A database is built for eyes up to that of the scene's view.
double eye_distance(const Vec3d& eye, const Box& bounds);

/// The distance from a cell within which a primitive must be listed there, grid-local: more than the rounding of a ray and of its
/// hit's t can move the hit, for rays that start up to `distance` scene extents away (2^-21 of the extent times 1 + distance:
/// eight units in the last place of a float there), and never below 1e-3 of a finest cell. The traversal's planes, in double, add
/// nothing to it. For planes in layers, in_layer() (core/trace/primitive.h) moves a t by up to `layers` more units in its last
/// place.
double insertion_pad(const GridFrame& frame, double distance, std::int32_t layers = 0);

/// The screen's axes: right, up, and from the scene towards the eye.
std::array<Vec3d, 3> screen_axes(const View& view);

/// A point of the world in grid-local coordinates, not rounded.
inline Vec3d to_local(const GridFrame& frame, const Vec3d& point) { return (point - frame.origin) * frame.scale; }

}  // namespace dmpc::core
