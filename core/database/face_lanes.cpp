#include "core/database/face_lanes.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace dmpc::core {
namespace {

/// A few triangles.
class FaceLanes {
 public:
  static constexpr std::size_t count_max = 16;

  void put(std::size_t lane, const PrimitiveValues& triangle) {
    for (std::size_t row = 0; row < corner_.size(); ++row) {
      corner_[row][lane] = triangle.value[row];
    }
  }
  [[gnu::always_inline]] void find() {
    for (std::size_t lane = 0; lane < count_max; ++lane) {
      const FaceShape shape = FaceShape::of(corners(lane), {}, corner_rounding);
      normal_[0][lane] = shape.plane.normal.x;
      normal_[1][lane] = shape.plane.normal.y;
      normal_[2][lane] = shape.plane.normal.z;
      offset_[lane] = shape.plane.offset;
      altitude_[lane] = shape.altitude;
      moved_[lane] = shape.moved;
    }
  }
  Face face(std::size_t lane, std::uint32_t id, std::uint32_t object) const {
    FaceShape shape{.plane = {}, .altitude = altitude_[lane], .moved = moved_[lane]};
    shape.plane.normal = {normal_[0][lane], normal_[1][lane], normal_[2][lane]};
    shape.plane.offset = offset_[lane];
    return {corners(lane), shape, id, object};
  }

 private:
  template <class T>
  using Row = std::array<T, count_max>;

  std::array<Vec3d, 3> corners(std::size_t lane) const {
    const auto corner = [&](std::size_t row) {
      return Vec3d{double{corner_[row][lane]}, double{corner_[row + 1][lane]}, double{corner_[row + 2][lane]}};
    };
    return {corner(0), corner(3), corner(6)};
  }

  alignas(64) std::array<Row<float>, 9> corner_{};
  std::array<Row<double>, 3> normal_{};
  Row<double> offset_{}, altitude_{}, moved_{};
};

}  // namespace

std::vector<Face> faces_of(const Conversion& conversion, std::span<const std::uint32_t> ids, VectorWidth width) {
  std::vector<Face> faces;
  faces.reserve(ids.size());
  FaceLanes lanes;
  for (auto first = ids.begin(); first != ids.end();) {
    std::array<std::uint32_t, FaceLanes::count_max> triangles{};
    std::size_t count = 0;
    for (; first != ids.end() && count < FaceLanes::count_max; ++first) {
      if (conversion.primitives[*first].kind == PrimitiveKind::triangle) {
        lanes.put(count, conversion.primitives[*first]);
        triangles[count++] = *first;
      }
    }
    run_by(width, [&] { lanes.find(); });
    for (std::size_t lane = 0; lane < count; ++lane) {
      faces.push_back(lanes.face(lane, triangles[lane], conversion.sources[triangles[lane]].object));
    }
  }
  return faces;
}

}  // namespace dmpc::core
