// A mesh as files of scans have it: of vertices and faces that carry what the file says of them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "apps/foreign/mesh/placed_file.h"
#include "apps/foreign/mesh/polygon_mesh.h"
#include "apps/foreign/polygon/screen_colour.h"
#include "core/base/vec.h"

namespace dmpc::apps {

struct IndexedMesh {
  using Place = std::array<float, 2>;

  std::string name;                   ///< as PolygonMesh's
  std::vector<core::Vec3d> vertices;  ///< in the world
  std::vector<core::Vec3d> normals;   ///< a vertex each, or none
  std::vector<Place> places;          ///< on the texture, t downwards: a vertex each, or none
  std::vector<Color> colors;          ///< linear: a vertex each, or none
  FaceList faces;                     ///< each of at least 3 corners, which exist
  std::vector<Place> corner_places;   ///< a corner each, or none; come before those of vertices
  std::vector<Color> face_colors;     ///< linear: a face each, or none
  std::vector<std::uint32_t>
      face_materials;  ///< indices into a file's materials: a face each, or none, where all have material 0

  /// Throws core::RoomError if there are more corners than indices reach.
  void add_face(std::span<const std::uint32_t> corners);
};

/// Adds a mesh for each material that it has. Where faces have at most face_colors_max colours, each becomes a material, which
/// has the faces' one colour to the last bit; where they have more, corners have the colours. The first of the file's materials
/// is there.
void add_meshes(IndexedMesh mesh, PlacedFile& file);

}  // namespace dmpc::apps
