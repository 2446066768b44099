#include "apps/edge/viewer/address.h"

#include "core/base/expect.h"

namespace dmpc::apps {

namespace {

bool is_port(const std::string& text) {
  return !text.empty() && text.size() <= 5 && text.find_first_not_of("0123456789") == std::string::npos && std::stoi(text) >= 1 &&
         std::stoi(text) <= 65535;
}

}  // namespace

ViewerAddress parse_viewer_address(const std::string& text, std::string_view option) {
  const std::size_t colon = text.rfind(':');
  if (colon != std::string::npos) {
    ViewerAddress address{text.substr(0, colon), text.substr(colon + 1)};
    if (address.host.size() > 2 && address.host.front() == '[' && address.host.back() == ']') {
      address.host = address.host.substr(1, address.host.size() - 2);
    }
    if (!address.host.empty() && is_port(address.port)) {
      return address;
    }
  }
  throw core::UsageError(std::string(option) + "=" + text + ": expected HOST:PORT such as 127.0.0.1:14158");
}

}  // namespace dmpc::apps
