// A web server for this computer alone. This interface is independent of the library behind it: the module dmpc_http.so.
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

/// The parts of a request that are used. Missing headers are empty.
struct WebRequest {
  std::string method, path;
  std::string host, origin, fetch_site;  ///< headers Host, Origin and Sec-Fetch-Site
  bool brings_json = false;              ///< a POST of type application/json with a declared length of at most 4 KiB
  std::string json = {};                 ///< its body; other bodies are ignored
};

/// An answer of unlimited length.
class WebStream {
 public:
  virtual ~WebStream() = default;
  /// Returns false if the client has gone, has not read for a second, or the server ends.
  virtual bool send(std::string_view bytes) = 0;
};

struct WebAnswer {
  int status = 200;
  std::string type = "text/plain; charset=utf-8";
  std::string body;
  std::vector<std::pair<std::string, std::string>> headers = {};
  /// Instead of `body`: called on a thread of the server, until it returns or throws.
  std::function<void(WebStream&)> stream = {};
};

struct WebOptions {
  std::uint16_t port = 0;   ///< 0: any free one
  std::size_t threads = 8;  ///< a stream occupies one as long as it lasts
  /// Called by several threads at a time.
  std::function<WebAnswer(const WebRequest&)> answer;
};

/// Answers requests on its own threads, on 127.0.0.1, one request per connection. Each connection uses a thread's stack, a
/// request of at most 32 KiB, and the system's buffers; at most as many again as there are threads wait for one, and further
/// clients are asked to come later. A client that does not send its request within two seconds, does not read for one, or reads
/// less than 16 KiB a second is disconnected. Its end waits two seconds at most for answers in progress; streams end at once.
class WebServer {
 public:
  virtual ~WebServer() = default;
  virtual std::uint16_t port() const = 0;
};

/// The module's interface.
struct WebLibrary {
  /// nullptr, with errno set, if the port is not available.
  std::unique_ptr<WebServer> (*listen)(const WebOptions& options);
};

/// Opened at the first call, as open_module() says.
const WebLibrary& web_library();

}  // namespace dmpc::apps
