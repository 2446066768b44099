// PLY (G. Turk 1994), in text and in binary.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "apps/foreign/mesh/placed_file.h"
#include "apps/foreign/mesh/scene_files.h"

namespace dmpc::apps {

/// The vertices and faces of the file form one mesh, whose faces may have materials (`element material`, `material_index`),
/// textures (`comment TextureFile`, `texnumber`), texture coordinates and colours; triangle strips (`tristrips`) are faces, too.
/// Elements and properties may be in any order. Numbers in text are read as doubles, whatever their type. Throws
/// core::InputError, with the line or byte.
PlacedFile read_ply(const std::string& path, SceneFiles& files);

/// Reads only the shape, as a mesh without a material, with normals and texture coordinates if the file has them. Adds one
/// sentence to `notes` per feature of the shape that is not shown.
PolygonMesh read_ply_shape(std::string_view file, SceneFiles& files, std::vector<std::string>& notes);

}  // namespace dmpc::apps
