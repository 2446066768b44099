// STL (3D Systems 1989), in text and in binary.
#pragma once

#include <string>

#include "apps/foreign/mesh/placed_file.h"
#include "apps/foreign/mesh/scene_files.h"

namespace dmpc::apps {

/// Each solid is a mesh, whose facets share no vertices; their normals are not read, since corners have them. Text is known by
/// its first word, `solid`, in letters of any case, by having no zero byte, and by not being as long as its count says, since
/// files in binary begin with that word, too. Colours of the whole (COLOR=) and of facets are shown. Throws core::InputError,
/// with the line or facet.
PlacedFile read_stl(const std::string& path, SceneFiles& files);

}  // namespace dmpc::apps
