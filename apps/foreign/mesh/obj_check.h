// Whether the faces of an OBJ file hold together, before Assimp reads it.
#pragma once

#include <string_view>

namespace dmpc::apps {

/// Throws core::InputError, with the line, for a face whose vertex, texture coordinate or normal does not exist: Assimp takes
/// those of the last two that do not exist for zeros.
void check_obj(std::string_view file);

}  // namespace dmpc::apps
