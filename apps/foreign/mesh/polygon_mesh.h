// A mesh of polygons, common to all readers.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/vec.h"

namespace dmpc::apps {

/// Polygons over a list of vertices.
struct FaceList {
  std::vector<std::uint32_t> corners;  ///< indices of vertices
  std::vector<std::uint32_t> ends;     ///< per face: one past its last corner

  std::size_t begin_of(std::size_t face) const { return face == 0 ? 0 : ends[face - 1]; }
};

/// Makes a list of triangles.
inline FaceList triangle_list(std::vector<std::uint32_t> corners) {
  FaceList faces{.corners = std::move(corners), .ends = {}};
  faces.ends.resize(faces.corners.size() / 3);
  for (std::size_t i = 0; i < faces.ends.size(); ++i) {
    faces.ends[i] = static_cast<std::uint32_t>(3 * (i + 1));
  }
  return faces;
}

/// Consecutive faces with the same appearance.
struct FaceRun {
  std::size_t end = 0;       ///< one past the last
  std::size_t material = 0;  ///< index into PlacedFile::materials
  bool has_places = true;    ///< texture coordinates for the material's texture, if the mesh has any
};

struct PolygonMesh {
  std::string name;                          ///< "mesh 3 'wheel'", for messages
  std::size_t material = 0;                  ///< likewise for all faces, or for the first run
  std::vector<core::Vec3d> vertices;         ///< in its own coordinates
  FaceList faces;                            ///< each with at least 3 corners; valid indices
  bool is_by_vertex = false;                 ///< the data below are per vertex, not per corner
  std::vector<core::Vec3d> normals;          ///< not normalized, or none; a face whose normals are all 0 is flat
  std::vector<std::array<float, 2>> places;  ///< texture coordinates, t downwards, or none
  std::vector<core::Vec3d> colors;           ///< linear, 0 to 1, multiplied by the material's; or none
  std::vector<double> alphas;                ///< alpha of `colors`, 0 to 1; none where all are 1
  std::vector<FaceRun> runs;                 ///< all faces, in order; or none

  /// The index of a corner's data among normals, places, colors and alphas.
  std::size_t of_corner(std::size_t corner) const { return is_by_vertex ? faces.corners[corner] : corner; }
  /// Converts data per vertex to data per corner.
  void spread_to_corners() {
    const auto spread = [this](auto& list) {
      if (!list.empty()) {
        std::remove_reference_t<decltype(list)> all;
        all.reserve(faces.corners.size());
        for (const std::uint32_t vertex : faces.corners) {
          all.push_back(list[vertex]);
        }
        list = std::move(all);
      }
    };
    if (std::exchange(is_by_vertex, false)) {
      spread(normals);
      spread(places);
      spread(colors);
      spread(alphas);
    }
  }
  /// Flips a face.
  void turn(std::size_t first_corner, std::size_t end) {
    const auto reverse = [&](auto& list) {
      if (!list.empty()) {
        std::reverse(list.begin() + static_cast<std::ptrdiff_t>(first_corner), list.begin() + static_cast<std::ptrdiff_t>(end));
      }
    };
    reverse(faces.corners);
    if (!is_by_vertex) {
      reverse(normals);
      reverse(places);
      reverse(colors);
      reverse(alphas);
    }
  }
};

}  // namespace dmpc::apps
