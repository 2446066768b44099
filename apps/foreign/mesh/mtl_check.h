// Looks for textures in a file of materials that Assimp passes over without a word.
#pragma once

#include <string>
#include <string_view>

namespace dmpc::apps {

/// A sentence about the textures of colour without a name and how many there are, or nothing. Throws core::InputError "PATH ..."
/// for a name that is too long.
std::string check_mtl(const std::string& path, std::string_view file);

}  // namespace dmpc::apps
