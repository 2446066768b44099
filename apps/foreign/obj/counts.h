// What an OBJ file has, counted by its lines' first words: a tenth of the time that reading takes.
#pragma once

#include <string_view>

#include "apps/formats/mesh_counts.h"

namespace dmpc::apps::obj {

MeshCounts counts_of(std::string_view file);

}  // namespace dmpc::apps::obj
