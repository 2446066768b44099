// How large a texture may be.
#pragma once

#include <cstdint>
#include <string>

namespace dmpc::apps {

/// Throws core::InputError "NAME: ..." for a texture that has no texels, or more than core::Texture::size_max along a side.
void check_texture_size(const std::string& name, std::int64_t width, std::int64_t height);

}  // namespace dmpc::apps
