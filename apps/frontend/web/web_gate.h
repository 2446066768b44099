// Who may look: only pages that come from this server, and who knows a secret that stands in the address.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "apps/frontend/web/web_server.h"

namespace dmpc::apps {

/// 128 random bits, as hexadecimal digits.
std::string random_token();

/// Other programs of this computer and other pages of a browser can send requests to any port, hence: the token in the path,
/// since streams of events have no headers of ours; the header Host names this server, or another name leads here (DNS
/// rebinding); the header Origin, if there is one, is this server's; a browser that says where a request comes from says from
/// here, or from nobody.
class WebGate {
 public:
  WebGate(std::string token, std::uint16_t port) : token_(std::move(token)), port_(std::to_string(port)) {}

  /// Where the page is.
  std::string address() const { return "http://127.0.0.1:" + port_ + "/" + token_ + "/"; }
  /// 0 if the request, a GET or a POST that brings JSON, may be answered; else the status by which it is refused. No page of
  /// another site can send JSON without asking first, which nobody answers.
  int refusal(const WebRequest& request) const;
  /// What stands behind the token. Requires a request that is not refused.
  std::string place_of(const WebRequest& request) const { return request.path.substr(token_.size() + 2); }

 private:
  bool is_host(std::string_view host) const;
  bool has_token(std::string_view path) const;

  std::string token_, port_;
};

}  // namespace dmpc::apps
