// PLY (G. Turk 1994), in text and in binary.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "apps/foreign/mesh/placed_file.h"
#include "apps/foreign/mesh/scene_files.h"

namespace dmpc::apps {

/// The vertices and faces of the file are one mesh, whose faces may have materials (`element material`, `material_index`),
/// textures (`comment TextureFile`, `texnumber`), places on these and colours; strips of triangles (`tristrips`) are faces, too.
/// Elements and properties come in any order. Numbers in text are read as doubles, whatever type they have. Throws
/// core::InputError, with the line or byte.
PlacedFile read_ply(const std::string& path, SceneFiles& files);

/// The shape alone of such a file, as a mesh without a material, with normals and places on a texture if the file has them.
/// `notes` gets sentences about what of the shape is not shown.
PolygonMesh read_ply_shape(std::string_view file, SceneFiles& files, std::vector<std::string>& notes);

}  // namespace dmpc::apps
