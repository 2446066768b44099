#include "core/database/faces/exact_corners.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/base/expect.h"
#include "core/record/coordinate.h"
#include "core/scene/frame.h"
#include "core/scene/triangulate.h"

namespace dmpc::core {
namespace {

using Corners = std::array<Vec3d, 3>;

/// Whether these corners, once rounded, are those of the triangle.
bool become(const Corners& corners, const PrimitiveValues& triangle) {
  for (std::size_t row = 0; row < 9; ++row) {
    if (coordinate_of(corners[row / 3][row % 3]) != triangle.value[row]) {
      return false;
    }
  }
  return true;
}

/// Finds the corners of a polygon's triangles, one after the other.
class CornerFinder {
 public:
  CornerFinder(const Scene& scene, const GridFrame& frame) : scene_(scene), frame_(frame) {}

  const Corners& corners_of(const PrimitiveValues& triangle, std::uint32_t object) {
    if (object != object_ || triangles_.empty()) {
      divide(object);
    }
    for (std::size_t tried = 0; tried < triangles_.size(); ++tried) {
      const Corners& corners = triangles_[next_];
      next_ = (next_ + 1) % triangles_.size();
      if (become(corners, triangle)) {
        return corners;
      }
    }
    expect(false, "a triangle is made of the corners of its object");
    return triangles_[0];
  }

 private:
  void divide(std::uint32_t index) {
    const Object& object = scene_.objects[index];
    const auto vertices = std::span(scene_.vertices).subspan(object.first, object.vertex_count);
    const auto local = [&](std::uint32_t vertex) { return to_local(frame_, vertices[vertex]); };
    triangles_.clear();
    for (const auto& corners : triangulate(vertices)) {
      triangles_.push_back({local(corners[0]), local(corners[1]), local(corners[2])});
    }
    object_ = index;
    next_ = 0;
  }

  const Scene& scene_;
  const GridFrame& frame_;
  std::uint32_t object_ = 0;
  std::vector<Corners> triangles_;
  std::size_t next_ = 0;
};

}  // namespace

bool put_exact_corners(const Scene& scene, const GridFrame& frame, const Conversion& conversion, std::span<Face> faces) {
  CornerFinder finder(scene, frame);
  bool found = false;
  for (Face& face : faces) {
    if (face.altitude < low_altitude && !face.is_level()) {
      face = Face(finder.corners_of(conversion.primitives[face.id], face.object), {}, corner_rounding, face.id, face.object);
      face.is_by_doubles = true;
      found = true;
    }
  }
  return found;
}

std::vector<Face> exact_faces(const Scene& scene, const GridFrame& frame, const Conversion& conversion,
                              std::span<const std::uint32_t> ids) {
  const Vec3d beside{std::fabs(frame.origin.x * frame.scale), std::fabs(frame.origin.y * frame.scale),
                     std::fabs(frame.origin.z * frame.scale)};
  CornerFinder finder(scene, frame);
  std::vector<Face> faces;
  faces.reserve(ids.size());
  for (const std::uint32_t id : ids) {
    const std::uint32_t object = conversion.sources[id].object;
    faces.emplace_back(finder.corners_of(conversion.primitives[id], object), beside,
                       std::max(exact_rounding, scene.coordinate_rounding), id, object);
    faces.back().moved += exact_rounding;
    faces.back().is_by_doubles = scene.coordinate_rounding <= exact_rounding;
  }
  return faces;
}

}  // namespace dmpc::core
