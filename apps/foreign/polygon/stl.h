// STL (3D Systems 1989), in text and in binary.
#pragma once

#include <string>

#include "apps/foreign/mesh/placed_file.h"
#include "apps/foreign/mesh/scene_files.h"

namespace dmpc::apps {

/// Each solid becomes a mesh whose facets share no vertices. The normals are not read, since they follow from the corners. A
/// text file is recognized by the first word `solid`, in any case, by the absence of zero bytes, and by a length that differs
/// from the one its facet count implies, since binary files may begin with that word, too. Colours of the object (COLOR=) and of
/// facets are shown. Throws core::InputError, with the line or facet.
PlacedFile read_stl(const std::string& path, SceneFiles& files);

}  // namespace dmpc::apps
