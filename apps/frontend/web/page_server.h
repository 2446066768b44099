// One page for browsers of this computer, the stream of its events, and what it sends back.
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

/// Serves a page, with a secret in its address, and `events` beside it. Nothing else is there, and nobody else may look
/// (WebGate). Beyond what a viewer takes of the server (WebServer) it keeps the page and what the feed keeps.
///
/// Thread safety: any thread.
class PageServer {
 public:
  struct Page {
    std::string html;
    std::string policy;  ///< Content-Security-Policy
  };
  struct Service {
    std::string option;  ///< that names the port, such as "--serve"
    Page page;
    std::size_t important;  ///< the feed's important slots
    std::chrono::milliseconds interval = LiveFeed::interval_usual;
    /// By the place to which it is sent: what a page may send, as JSON of at most 4 KiB. Called by several threads at a time.
    std::map<std::string, std::function<WebAnswer(const std::string&)>> takes = {};
  };

  /// Further viewers are asked to come back later.
  static constexpr std::size_t viewers_max = 48;

  /// Listens, on any port if that is 0. Throws core::InputError, naming the option, if the port cannot be had, and as
  /// open_module().
  PageServer(std::uint16_t port, Service service);
  PageServer(const PageServer&) = delete;
  PageServer& operator=(const PageServer&) = delete;

  /// Where a browser finds it.
  std::string address() const { return gate_->address(); }
  /// What viewers are told.
  LiveFeed& feed() { return feed_; }
  /// Whether anybody has come.
  bool has_had_visitors() const { return has_had_visitors_.load(std::memory_order_relaxed); }

  /// All is over: viewers are told so by the event "end", and, if there is one, where another page is now in place of the first.
  /// Waits until they have that, or else have heard all, for two seconds at most, or until a stop is requested. Only the first
  /// call counts.
  void end(std::string_view json, std::optional<Page> last = {}, const std::stop_token& stop = {});

 private:
  WebAnswer answer(const WebRequest& request);
  WebAnswer answer_at(const std::string& place, const WebRequest& request);
  WebAnswer page();
  WebAnswer events();

  const Service service_;
  LiveFeed feed_;
  std::atomic<bool> has_had_visitors_ = false;
  std::mutex mutex_;  ///< guards what follows, up to the server
  Page page_;
  bool has_ended_ = false;
  std::size_t given_since_ = 0;        ///< pages
  std::optional<WebGate> gate_;        ///< set before anything can be asked
  std::unique_ptr<WebServer> server_;  ///< ends before what its threads use
};

}  // namespace dmpc::apps
