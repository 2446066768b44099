// Where a program listens that shows pictures.
#pragma once

#include <string>
#include <string_view>

namespace dmpc::apps {

struct ViewerAddress {
  std::string host = "127.0.0.1";
  std::string port = "14158";
};

/// "127.0.0.1:14158", "[::1]:14158". Throws core::UsageError naming `option` for anything else.
ViewerAddress parse_viewer_address(const std::string& text, std::string_view option);

}  // namespace dmpc::apps
