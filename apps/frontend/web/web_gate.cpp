#include "apps/frontend/web/web_gate.h"

#include <sys/random.h>

#include <array>

#include "core/base/expect.h"

namespace dmpc::apps {

std::string random_token() {
  std::array<unsigned char, 16> bytes{};
  core::expect(::getrandom(bytes.data(), bytes.size(), 0) == static_cast<ssize_t>(bytes.size()), "random numbers can be had");
  constexpr std::string_view digits = "0123456789abcdef";
  std::string token;
  for (const unsigned char byte : bytes) {
    token += digits[byte >> 4U];
    token += digits[byte & 15U];
  }
  return token;
}

bool WebGate::is_host(std::string_view host) const { return host == "127.0.0.1:" + port_ || host == "localhost:" + port_; }

/// Takes as long for each wrong one.
bool WebGate::has_token(std::string_view path) const {
  if (path.size() < token_.size() + 2) {
    return false;
  }
  unsigned difference = static_cast<unsigned>(path.front() ^ '/') | static_cast<unsigned>(path[token_.size() + 1] ^ '/');
  for (std::size_t i = 0; i < token_.size(); ++i) {
    difference |= static_cast<unsigned>(path[i + 1] ^ token_[i]);
  }
  return difference == 0;
}

int WebGate::refusal(const WebRequest& request) const {
  constexpr int forbidden = 403, wrong_method = 405, wrong_type = 415;
  const bool is_from_here = request.origin.empty() || request.origin == "http://" + request.host;
  const bool is_site_known = request.fetch_site.empty() || request.fetch_site == "none" || request.fetch_site == "same-origin";
  if (!is_host(request.host) || !is_from_here || !is_site_known || !has_token(request.path)) {
    return forbidden;
  }
  if (request.method == "POST") {
    return request.brings_json ? 0 : wrong_type;
  }
  return request.method == "GET" ? 0 : wrong_method;
}

}  // namespace dmpc::apps
