// Attributes of mesh faces in scan formats.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "apps/foreign/mesh/placed_file.h"
#include "apps/foreign/polygon/screen_colour.h"

namespace dmpc::apps {

/// Each vector has one entry per face, or none.
struct FaceLooks {
  std::vector<Color> colors;             ///< linear
  std::vector<std::uint32_t> materials;  ///< indices into a file's materials; if empty, all faces have material 0

  /// Drops the face colours, with a note, if the vertices have colours as well.
  void give_way_to(const PolygonMesh& mesh, std::vector<std::string>& notes);
};

/// Throws core::CapacityError if there are more corners than indices can address.
void add_face(std::span<const std::uint32_t> corners, PolygonMesh& mesh);

/// Adds a mesh that has faces, grouped by material in their order. Up to face_colors_max face colours become materials, which
/// reproduce them exactly; otherwise colours are stored per corner. The file's first material must exist.
void add_mesh(PolygonMesh mesh, FaceLooks looks, PlacedFile& file);

}  // namespace dmpc::apps
