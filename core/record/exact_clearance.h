// How far rays start off a plane that the file's doubles tell.
#pragma once

namespace dmpc::core {

/// By so much of the largest coordinates, each by its share in the normal: more than what doubles leave of a ray's start, and of
/// its way to the plane.
inline constexpr double exact_clearance = 0x1p-47;
/// What two floats, in which a start is kept, leave of each of its coordinates.
inline constexpr double start_rounding = 0x1p-48;

}  // namespace dmpc::core
