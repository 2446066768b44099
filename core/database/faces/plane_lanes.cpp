#include "core/database/faces/plane_lanes.h"

#include <algorithm>

#include "core/base/expect.h"

namespace dmpc::core {

template <std::size_t axis>
[[gnu::always_inline]] inline void PlaneLanes::find_along() {
  for (std::size_t lane = 0; lane < count_max; ++lane) {
    PlacedFace face{.normal = {normal_[0][lane], normal_[1][lane], normal_[2][lane]},
                    .corner = {corner_[0][lane], corner_[1][lane], corner_[2][lane]},
                    .moved = moved_[lane],
                    .altitude = altitude_[lane],
                    .tilted = tilted_[lane],
                    .rounded = rounded_[lane]};
    const double error = face.slope_error(size_);
    const bool is_seen = face.is_seen_along(axis, error, size_);
    face.normal[axis] = is_seen ? face.normal[axis] : 1.0;  // any number with which the results fit integers
    const PlanePlace place = place_along(axis, face, is_seen ? error : 0.0, size_, around_);
    seen_[axis][lane] = is_seen ? 1 : 0;
    first_[axis][0][lane] = place.slopes.first;
    last_[axis][0][lane] = place.slopes.last;
    first_[axis][1][lane] = place.other_slopes.first;
    last_[axis][1][lane] = place.other_slopes.last;
    first_[axis][2][lane] = place.heights.first;
    last_[axis][2][lane] = place.heights.last;
  }
}

void PlaneLanes::find(std::span<const Face> faces) {
  expect(!faces.empty() && faces.size() <= count_max, "there is a lane for each face");
  for (std::size_t lane = 0; lane < count_max; ++lane) {
    const Face& face = faces[std::min(lane, faces.size() - 1)];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      normal_[axis][lane] = face.plane.normal[axis];
      corner_[axis][lane] = face.corner[0][axis];
    }
    moved_[lane] = face.moved;
    altitude_[lane] = face.altitude;
    tilted_[lane] = face.is_level() ? 0 : 1;
    rounded_[lane] = face.is_by_doubles ? 0 : 1;
  }
  run_by(width_, [this] {
    find_along<0>();
    find_along<1>();
    find_along<2>();
  });
}

}  // namespace dmpc::core
