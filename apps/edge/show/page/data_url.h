// Bytes of a file within a page, so that it needs no other file.
#pragma once

#include <string>
#include <string_view>

namespace dmpc::apps::html {

/// "data:TYPE;base64,..." (RFC 2397, RFC 4648).
std::string data_url(std::string_view type, std::string_view bytes);

}  // namespace dmpc::apps::html
