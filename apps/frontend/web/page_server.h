// Serves one page to browsers on this computer, its event stream, and receives what it sends back.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>

#include "apps/frontend/web/live_feed.h"
#include "apps/frontend/web/web_gate.h"
#include "apps/frontend/web/web_server.h"

namespace dmpc::apps {

/// Serves a page, with a secret in its address, and `events` beside it. There is nothing else, and access is checked by WebGate.
/// It keeps the page and the feed, in addition to the server's memory per viewer (WebServer).
///
/// Thread safety: any thread.
class PageServer {
 public:
  struct Page {
    std::string html;
    std::string policy;  ///< Content-Security-Policy
  };
  struct Service {
    std::string option;  ///< option for the port, such as "--serve"
    Page page;
    std::size_t important;  ///< the feed's important slots
    std::chrono::milliseconds interval = LiveFeed::interval_usual;
    /// Handlers, by path, of what a page may send as JSON of at most 4 KiB. Called by several threads at a time.
    std::map<std::string, std::function<WebAnswer(const std::string&)>> takes = {};
  };

  /// Further viewers are asked to come back later.
  static constexpr std::size_t viewers_max = 48;

  /// Listens; port 0 is any free one. Throws core::InputError, naming the option, if the port is not available, and as
  /// open_module() does.
  PageServer(std::uint16_t port, Service service);
  PageServer(const PageServer&) = delete;
  PageServer& operator=(const PageServer&) = delete;

  /// The address for a browser.
  std::string address() const { return gate_->address(); }
  /// The viewers' events.
  LiveFeed& feed() { return feed_; }
  /// Whether there has been any viewer.
  bool has_had_visitors() const { return has_had_visitors_.load(std::memory_order_relaxed); }

  /// Ends the feed by the event "end", which tells viewers also if `last` is now served instead of the first page. Waits until
  /// they have that page, or otherwise all events, for two seconds at most, or until a stop is requested. Only the first call
  /// counts.
  void end(std::string_view json, std::optional<Page> last = {}, const std::stop_token& stop = {});

 private:
  WebAnswer answer(const WebRequest& request);
  WebAnswer answer_at(const std::string& place, const WebRequest& request);
  WebAnswer page();
  WebAnswer events();

  const Service service_;
  LiveFeed feed_;
  std::atomic<bool> has_had_visitors_ = false;
  std::mutex mutex_;  ///< guards the members below, up to the server
  Page page_;
  bool has_ended_ = false;
  std::size_t given_since_ = 0;        ///< number of pages served
  std::optional<WebGate> gate_;        ///< set before any request arrives
  std::unique_ptr<WebServer> server_;  ///< ends before the members that its threads use
};

}  // namespace dmpc::apps
