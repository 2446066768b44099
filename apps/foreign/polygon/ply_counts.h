// What a PLY file's header says that there is.
#pragma once

#include <string_view>

#include "apps/foreign/polygon/ply_header.h"
#include "apps/formats/mesh_counts.h"

namespace dmpc::apps {

/// Lists are as long as all that is no list leaves room for in the file.
MeshCounts counts_of_ply(const PlyHeader& header, std::string_view file);

}  // namespace dmpc::apps
