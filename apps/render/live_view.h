// A render in a browser while it goes on: --serve.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
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

/// How all ends.
struct LiveEnd {
  std::string said;          ///< as a sentence
  std::string figures = {};  ///< lines that follow it
  std::string page = {};     ///< which takes the live one's place, if there is one
};

/// Serves one page, with a secret in its address, and beside it the stream of its events. Whoever has it may stop what goes on.
/// A thread of its own makes them: the host and the nodes leave what they have where it finds it (LivePicture,
/// LiveCounts), and wait neither for it nor for a viewer. Beyond what a viewer takes of the server (WebServer) it keeps 4/3 bytes
/// a byte of the picture as it is shown.
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

  /// Where a browser finds it.
  std::string address() const { return server_.address(); }
  /// Whether anybody has come.
  bool has_had_visitors() const { return server_.has_had_visitors(); }
  /// The error that stopped the events; empty if there was none.
  std::string complaint();

  /// What is going on, as a sentence.
  void say(const std::string& phase);
  /// A picture is known, the first or, of the same size and on the same nodes, the next, between two runs. `start`: what of the
  /// first is done before, if anything.
  void begin(const LiveHead& head, const core::PartialPicture* start);
  /// Looks on at the nodes from begin() on; nullptr if it is not shown what they do.
  nodes::Observer* observer() { return counts_.get(); }

  void watch(const core::Film& film, const core::Refinement& pass, std::uint32_t pixel);
  void update(std::uint32_t done, std::uint32_t total);

  /// The picture as it is in the end; nothing of the run follows.
  void show(const core::Film& film);
  /// All is over. Viewers are told so, and where there is a page to ask for it; waits until they have it, or else have heard
  /// that, for two seconds at most, or until a stop is requested. Only the first call counts.
  void end(LiveEnd end, const std::stop_token& stop = {});
  /// Until it is requested.
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
  std::mutex mutex_;  ///< guards what follows
  std::string phase_ = "The scene is read and built.";
  std::string complaint_;
  LiveHead head_;
  LiveSteps steps_;
  std::optional<LiveMoment> last_;
  std::jthread publisher_;
};

}  // namespace dmpc::apps
