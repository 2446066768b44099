// Bytes of a file within a page, so that it needs no other file.
#pragma once

#include <string>
#include <string_view>

namespace dmpc::apps::html {

/// As RFC 4648 has it, with padding.
std::string base64(std::string_view bytes);

/// "data:TYPE;base64,..." (RFC 2397).
std::string data_url(std::string_view type, std::string_view bytes);

}  // namespace dmpc::apps::html
