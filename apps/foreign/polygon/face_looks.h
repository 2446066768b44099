// What the faces of a mesh have, as files of scans say it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "apps/foreign/mesh/placed_file.h"
#include "apps/foreign/polygon/screen_colour.h"

namespace dmpc::apps {

/// A face each, or none.
struct FaceLooks {
  std::vector<Color> colors;             ///< linear
  std::vector<std::uint32_t> materials;  ///< indices into a file's materials; without any all have material 0

  /// If both vertices and faces have colours, the vertices' are shown; `notes` gets a note.
  void give_way_to(const PolygonMesh& mesh, std::vector<std::string>& notes);
};

/// Throws core::CapacityError if there are more corners than indices reach.
void add_face(std::span<const std::uint32_t> corners, PolygonMesh& mesh);

/// Adds a mesh that has faces, those of one material together, in their order. Where faces have at most face_colors_max colours,
/// each becomes a material, which has the faces' one colour to the last bit; where they have more, corners have the colours. The
/// first of the file's materials is there.
void add_mesh(PolygonMesh mesh, FaceLooks looks, PlacedFile& file);

}  // namespace dmpc::apps
