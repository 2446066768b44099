// Embeds a file's bytes in a page, so that it needs no other file.
#pragma once

#include <string>
#include <string_view>

#include "apps/frontend/system/base64.h"

namespace dmpc::apps::html {

/// "data:TYPE;base64,..." (RFC 2397).
inline std::string data_url(std::string_view type, std::string_view bytes) {
  return "data:" + std::string(type) + ";base64," + base64(bytes);
}

}  // namespace dmpc::apps::html
