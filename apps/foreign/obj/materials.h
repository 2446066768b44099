// The materials of the faces of an OBJ file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/foreign/mesh/placed_file.h"
#include "apps/foreign/obj/geometry.h"
#include "apps/foreign/obj/libraries.h"

namespace dmpc::apps::obj {

struct Materials {
  std::vector<FileMaterial> list;    ///< used materials, in the order of the faces
  std::vector<TexturePlace> places;  ///< mapping of texture coordinates, per material
  std::vector<std::uint32_t> of_runs;
  std::vector<std::string> notes;  ///< one sentence per feature that is not shown
};

/// Faces without a material, and faces whose material no library defines, get the grey default material; the latter case is
/// noted. A texture is left out, with a note, if no face with it has texture coordinates.
Materials materials_of(const Geometry& geometry, const Libraries& libraries);

}  // namespace dmpc::apps::obj
