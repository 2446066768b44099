// Whether a PLY file is whole, before Assimp reads it, and what Assimp does not tell of it.
#pragma once

#include <string_view>

namespace dmpc::apps {

/// Throws core::InputError, with the line, for a header that is none or does not end, and for a body that is shorter than its
/// header says. Values are not looked at.
void check_ply(std::string_view file);

/// Whether a file that is whole has materials.
bool has_ply_material(std::string_view file);

}  // namespace dmpc::apps
