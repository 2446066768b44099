// Bytes of a file within a page, so that it needs no other file.
#pragma once

#include <string>
#include <string_view>

#include "apps/picture/image_file.h"

namespace dmpc::apps::html {

/// "data:TYPE;base64,..." (RFC 2397, RFC 4648).
std::string data_url(std::string_view type, std::string_view bytes);

/// The picture as a PNG. Throws core::InputError if no temporary file can be written.
std::string data_url(const Image& image);

}  // namespace dmpc::apps::html
