#include "core/database/plane_lanes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "apps/lab/bench/stability/random.h"
#include "core/database/conversion.h"
#include "core/database/face_lanes.h"

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

/// Triangles of all sizes: every fourth lies level, and every eighth is a sphere in its place.
core::Conversion some_primitives(std::size_t count) {
  Random random(1);
  core::Conversion conversion;
  for (std::uint32_t i = 0; i < count; ++i) {
    PrimitiveValues primitive{.kind = i % 8 == 7 ? PrimitiveKind::sphere : PrimitiveKind::triangle};
    const Vec3d place = random.in_box(-1, 1);
    for (std::size_t row = 0; row < 9; ++row) {
      const double off = i % 4 == 3 && row % 3 == i % 3 ? 0 : random.in_box(-1, 1).x;
      primitive.value[row] = static_cast<float>(place[row % 3] + off * (i % 2 == 0 ? 1 : 0x1p-12));
    }
    conversion.primitives.push_back(primitive);
    conversion.sources.push_back({i / 2});
  }
  return conversion;
}

std::vector<Face> one_by_one(const core::Conversion& conversion) {
  std::vector<Face> faces;
  for (std::uint32_t id = 0; id < conversion.primitives.size(); ++id) {
    if (conversion.primitives[id].kind == PrimitiveKind::triangle) {
      faces.emplace_back(conversion.primitives[id], id, conversion.sources[id].object);
    }
  }
  return faces;
}

bool are_alike(const Face& a, const Face& b) {
  return a.corner == b.corner && a.plane.normal == b.plane.normal && a.plane.offset == b.plane.offset &&
         a.altitude == b.altitude && a.moved == b.moved && a.id == b.id && a.object == b.object && !a.is_by_doubles;
}

bool are_equal(const core::BucketRange& a, const core::BucketRange& b) { return a.first == b.first && a.last == b.last; }

TEST_CASE("faces that are found side by side have the bits of each alone, by every width of vectors") {
  for (const std::size_t count : {0, 1, 15, 16, 17, 1000}) {
    const core::Conversion conversion = some_primitives(count);
    std::vector<std::uint32_t> ids(count);
    std::iota(ids.begin(), ids.end(), 0U);
    const std::vector<Face> alone = one_by_one(conversion);
    for (const VectorWidth width : widths()) {
      const std::vector<Face> faces = core::faces_of(conversion, ids, width);
      CHECK(std::equal(faces.begin(), faces.end(), alone.begin(), alone.end(), are_alike));
    }
  }
}

TEST_CASE("places of planes that are found side by side are those of each alone, by every width of vectors") {
  const std::vector<Face> faces = one_by_one(some_primitives(1000));
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
