// A server of web pages on this computer alone, without a word of the library that is one: the module dmpc_http.so.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/frontend/system/module.h"

namespace dmpc::apps {

/// As far as somebody looks at it. Headers that are not there are empty.
struct WebRequest {
  std::string method, path;
  std::string host, origin, fetch_site;  ///< headers Host, Origin and Sec-Fetch-Site
  bool brings_json = false;              ///< a POST whose type is application/json, of at most 4 KiB, as it says beforehand
  std::string json = {};                 ///< what it brings; whatever else brings something is not listened to
};

/// Where an answer goes that has no end yet.
class WebStream {
 public:
  virtual ~WebStream() = default;
  /// False if nobody listens any more: gone, deaf for a second, or the server ends.
  virtual bool send(std::string_view bytes) = 0;
};

struct WebAnswer {
  int status = 200;
  std::string type = "text/plain; charset=utf-8";
  std::string body;
  std::vector<std::pair<std::string, std::string>> headers = {};
  /// In place of `body`: called on a thread of the server, until it returns or throws.
  std::function<void(WebStream&)> stream = {};
};

struct WebOptions {
  std::uint16_t port = 0;   ///< 0: any that is free
  std::size_t threads = 8;  ///< a stream holds one as long as it lasts
  /// Called by several threads at a time.
  std::function<WebAnswer(const WebRequest&)> answer;
};

/// Answers on threads of its own, on 127.0.0.1, one request a connection. Each connection takes a thread's stack, a request of
/// at most 32 KiB, and what the system buffers; as many again as there are threads wait at most for one, and who comes then is
/// told to come later. Whoever does not say what he wants within two seconds, takes nothing for one or less than 16 KiB a second
/// is left alone. Its end waits for answers that have begun, for two seconds at most; streams end at once.
class WebServer {
 public:
  virtual ~WebServer() = default;
  virtual std::uint16_t port() const = 0;
};

/// The module's interface.
struct WebLibrary {
  /// nullptr, and errno, if the port cannot be had.
  std::unique_ptr<WebServer> (*listen)(const WebOptions& options);
};

/// Opened at the first call, as open_module() says.
const WebLibrary& web_library();

}  // namespace dmpc::apps
