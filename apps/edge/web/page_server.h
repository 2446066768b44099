// One page for browsers of this computer, the stream of its events, and what it sends back.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "apps/edge/web/live_feed.h"
#include "apps/edge/web/web_gate.h"
#include "apps/edge/web/web_server.h"

namespace dmpc::apps {

/// Serves a page, with a secret in its address, and `events` beside it. Nothing else is there, and nobody else may look
/// (WebGate). Beyond what a viewer takes of the server (WebServer) it keeps what the feed keeps.
///
/// Thread safety: any thread; what it is made with is called by several at a time.
class PageServer {
 public:
  struct Page {
    std::string html;
    std::string policy;  ///< Content-Security-Policy
  };
  struct Service {
    std::function<Page()> page;
    /// By the place to which it is sent: what a page may send, as JSON of at most 4 KiB.
    std::map<std::string, std::function<WebAnswer(const std::string&)>> takes = {};
  };

  /// Who comes when so many look on is told to come later.
  static constexpr std::size_t viewers_max = 48;

  /// Listens, on any port if that is 0. Throws core::InputError, naming `option`, such as "--serve", if the port cannot be had,
  /// and as open_module(). `feed` outlives it.
  PageServer(std::uint16_t port, const std::string& option, LiveFeed& feed, Service service);
  PageServer(const PageServer&) = delete;
  PageServer& operator=(const PageServer&) = delete;

  /// Where a browser finds it.
  std::string address() const { return gate_->address(); }
  /// Whether anybody has come.
  bool has_had_visitors() const { return has_had_visitors_.load(std::memory_order_relaxed); }

 private:
  WebAnswer answer(const WebRequest& request);
  WebAnswer answer_at(const std::string& place, const WebRequest& request);
  WebAnswer page();
  WebAnswer events();

  LiveFeed& feed_;
  const Service service_;
  std::atomic<bool> has_had_visitors_ = false;
  std::mutex mutex_;                   ///< guards the gate
  std::optional<WebGate> gate_;        ///< set before anything can be asked
  std::unique_ptr<WebServer> server_;  ///< ends before what its threads use
};

}  // namespace dmpc::apps
