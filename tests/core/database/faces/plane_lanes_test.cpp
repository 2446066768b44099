#include "core/database/faces/plane_lanes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "apps/lab/bench/stability/random.h"
#include "core/database/faces/face.h"

namespace dmpc::tests::plane_lanes_test {
namespace {

using apps::Random;
using core::Face;
using core::PlaneLanes;
using core::PlanePlace;
using core::PrimitiveKind;
using core::PrimitiveValues;
using core::Vec3d;
using core::VectorWidth;

std::vector<VectorWidth> widths() {
  std::vector<VectorWidth> all{VectorWidth::any, VectorWidth::bits_256, VectorWidth::bits_512};
  std::erase_if(all, [](VectorWidth width) { return width > core::vector_width(); });
  return all;
}

/// Faces of all sizes; every fourth is level.
std::vector<Face> some_faces(std::uint32_t count) {
  Random random(1);
  std::vector<Face> faces;
  for (std::uint32_t i = 0; i < count; ++i) {
    PrimitiveValues triangle{.kind = PrimitiveKind::triangle};
    const Vec3d place = random.in_box(-1, 1);
    for (std::size_t row = 0; row < 9; ++row) {
      const double off = i % 4 == 3 && row % 3 == i % 3 ? 0 : random.in_box(-1, 1).x;
      triangle.value[row] = static_cast<float>(place[row % 3] + off * (i % 2 == 0 ? 1 : 0x1p-12));
    }
    faces.emplace_back(triangle, i, i / 2);
  }
  return faces;
}

bool are_equal(const core::BucketRange& a, const core::BucketRange& b) { return a.first == b.first && a.last == b.last; }

TEST_CASE("places of planes that are found side by side are those of each alone, by every width of vectors") {
  const std::vector<Face> faces = some_faces(1000);
  const core::Surroundings around{{0.1, -0.2, 0.3}, 2.5};
  for (const core::BucketSize& size : {core::fine_buckets, core::coarse_buckets}) {
    for (const VectorWidth width : widths()) {
      PlaneLanes lanes(size, around, width);
      std::size_t seen = 0, wrong = 0;
      for (std::size_t i = 0; i < faces.size(); ++i) {
        lanes.find(std::span(faces).subspan(i, std::min<std::size_t>(1 + i % PlaneLanes::count_max, faces.size() - i)));
        const Face& face = faces[i];
        const core::PlacedFace placed{.normal = face.plane.normal,
                                      .corner = face.corner[0],
                                      .moved = face.moved,
                                      .altitude = face.altitude,
                                      .tilted = face.is_level() ? 0.0 : 1.0};
        const double error = placed.slope_error(size);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const bool is_seen = placed.is_seen_along(axis, error, size);
          wrong += lanes.is_seen(0, axis) == is_seen ? 0 : 1;
          if (is_seen) {
            const PlanePlace place = lanes.place(0, axis), alone = core::place_along(axis, placed, error, size, around);
            wrong += are_equal(place.slopes, alone.slopes) && are_equal(place.other_slopes, alone.other_slopes) &&
                             are_equal(place.heights, alone.heights)
                         ? 0
                         : 1;
            ++seen;
          }
        }
      }
      CHECK(wrong == 0);
      CHECK(seen > faces.size() / 4);
    }
  }
}

TEST_CASE("a plane is seen along the axis that it faces most, and along two that it faces alike") {
  const auto seen_along = [](const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    const std::vector<Face> faces{Face({a, b, c}, {}, core::corner_rounding, 0, 0)};
    PlaneLanes lanes(core::fine_buckets, {{}, 1});
    lanes.find(faces);
    return std::array{lanes.is_seen(0, 0), lanes.is_seen(0, 1), lanes.is_seen(0, 2)};
  };
  CHECK(seen_along({0, 0, 0.25}, {0.5, 0, 0.25}, {0, 0.5, 0.25}) == std::array{false, false, true});
  CHECK(seen_along({0, 0, 0}, {0.5, -0.5, 0}, {0, 0, 0.5}) == std::array{true, true, false});
  CHECK(seen_along({0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}) == std::array{true, true, true});
}

}  // namespace
}  // namespace dmpc::tests::plane_lanes_test
