// Access control: only pages from this server, and clients that know the secret in the address.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "apps/frontend/web/web_server.h"

namespace dmpc::apps {

/// 128 random bits, as hexadecimal digits.
std::string random_token();

/// Other programs on this computer and other pages in a browser can send requests to any port. Therefore a request needs: the
/// token in the path, since event streams cannot have custom headers; the header Host with this server's name, against DNS
/// rebinding; the header Origin, if present, with this server's; and Sec-Fetch-Site, if present, with this server or none.
class WebGate {
 public:
  WebGate(std::string token, std::uint16_t port) : token_(std::move(token)), port_(std::to_string(port)) {}

  /// The page's address.
  std::string address() const { return "http://127.0.0.1:" + port_ + "/" + token_ + "/"; }
  /// 0 if the request, a GET or a POST with JSON, may be answered; else the status of the refusal. A page of another site cannot
  /// send JSON without a preflight request, which is not answered.
  int refusal(const WebRequest& request) const;
  /// The path behind the token. Requires a request that is not refused.
  std::string place_of(const WebRequest& request) const { return request.path.substr(token_.size() + 2); }

 private:
  bool is_host(std::string_view host) const;
  bool has_token(std::string_view path) const;

  std::string token_, port_;
};

}  // namespace dmpc::apps
