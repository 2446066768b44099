// Shows a running render in a browser: --serve.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

#include "apps/frontend/web/page_server.h"
#include "apps/render/live_events.h"
#include "apps/render/live_picture.h"
#include "apps/render/live_steps.h"
#include "nodes/observers/live_counts.h"

namespace dmpc::apps {

/// The final state.
struct LiveEnd {
  std::string said;          ///< the state as a sentence
  std::string figures = {};  ///< lines below it
  std::string page = {};     ///< the page that replaces the live one, if there is one
};

/// Serves one page, with a secret in its address, and its event stream. Anybody who has the address may stop the run. A separate
/// thread makes the events: the host and the nodes leave their data in LivePicture and LiveCounts, and wait neither for that
/// thread nor for a viewer. In addition to the server's memory per viewer (WebServer) it takes 4/3 bytes per byte of the shown
/// picture.
///
/// Thread safety: one thread makes it, begins, ends and destroys it; watch() and update() are the host's.
class LiveView {
 public:
  /// Listens, on any port if that is 0; calls `stop` when a viewer asks for that, as often as one does and from any thread.
  /// Throws core::InputError, naming --serve, if the port cannot be had, and as open_module().
  LiveView(std::uint16_t port, const std::string& title, std::function<void()> stop);
  /// Viewers are notified of the end, unless they have been, and are disconnected within three seconds.
  ~LiveView();
  LiveView(const LiveView&) = delete;
  LiveView& operator=(const LiveView&) = delete;

  /// The address for a browser.
  std::string address() const { return server_.address(); }
  /// Whether there has been any viewer.
  bool has_had_visitors() const { return server_.has_had_visitors(); }
  /// The error that stopped the events; empty if there was none.
  std::string complaint();

  /// Shows the current phase, as a sentence.
  void say(const std::string& phase);
  /// Begins a picture between two runs: the first or, of the same size and on the same nodes, the next. `start`: what is already
  /// rendered of the first, if anything.
  void begin(const LiveHead& head, const core::PartialPicture* start);
  /// Observes the nodes from begin() on; nullptr if their activities are not shown.
  nodes::Observer* observer() { return counts_.get(); }

  void watch(const core::Film& film, const core::Refinement& pass, std::uint32_t pixel);
  void update(std::uint32_t done, std::uint32_t total);

  /// Shows the finished picture; nothing of the run follows.
  void show(const core::Film& film);
  /// Ends the events and informs viewers, also about a final page; waits until they have it, or otherwise this message, for two
  /// seconds at most, or until a stop is requested. Only the first call counts.
  void end(LiveEnd end, const std::stop_token& stop = {});
  /// Waits until it is requested.
  static void wait(const std::stop_token& stop);

 private:
  using Clock = std::chrono::steady_clock;

  void publish(const std::stop_token& stop);
  void publish_all(bool is_last = false);
  LiveState state(bool is_last);
  void publish_steps(LiveMoment moment);
  void notify_end(LiveEnd end, const std::stop_token& stop);
  void complain(const std::exception& error);
  void publish_tiles(const std::vector<PictureTile>& tiles);

  const Clock::time_point start_ = Clock::now();
  PageServer server_;
  std::unique_ptr<LivePicture> picture_;
  std::unique_ptr<nodes::LiveCounts> counts_;
  std::atomic<std::uint32_t> done_ = 0, total_ = 0, pass_ = 1;
  bool has_ended_ = false;
  std::mutex mutex_;  ///< guards the members below
  std::string phase_ = "The scene is read and built.";
  std::string complaint_;
  LiveHead head_;
  LiveSteps steps_;
  std::optional<LiveMoment> last_;
  std::jthread publisher_;
};

}  // namespace dmpc::apps
