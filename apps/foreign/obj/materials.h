// Which materials the faces of an OBJ file have.
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
  std::vector<TexturePlace> places;  ///< per material: how its texture coordinates are mapped
  std::vector<std::uint32_t> of_runs;
  std::vector<std::string> notes;  ///< what is not shown of them, a sentence each
};

/// The grey one for what names no material, and for names that no file of materials has, which is said. A texture that no face
/// has a place on is left out, which is said, too.
Materials materials_of(const Geometry& geometry, const Libraries& libraries);

}  // namespace dmpc::apps::obj
