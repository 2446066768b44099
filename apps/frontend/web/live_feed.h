// Events for viewers during a run, each at the rate at which it reads.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "apps/frontend/web/web_server.h"

namespace dmpc::apps {

/// Each slot has the newest event of its kind. A viewer gets the slots that have changed since its last look: a slow one misses
/// events but never the newest, a late one gets the current state, and nobody waits for a viewer. Memory: one event per slot for
/// all viewers, and a number per slot and viewer.
///
/// Thread safety: any thread; follow() on each viewer's own.
class LiveFeed {
 public:
  /// The first `important` slots go to a viewer at once; the others in batches of up to `bytes_at_once` bytes, but at least one
  /// event.
  explicit LiveFeed(std::size_t important, std::size_t bytes_at_once = bytes_usual,
                    std::chrono::milliseconds interval = interval_usual)
      : important_(important), bytes_at_once_(bytes_at_once), interval_(interval) {}

  /// An event as EventSource takes it (WHATWG, "Server-sent events"); `data` is one line.
  void put(std::size_t place, std::string_view name, std::string_view data);
  /// Sends all changes, then this event, and nothing more. Only the first call counts.
  void close(std::string_view name, std::string_view data);

  /// A seat for a viewer, held as long as it views; nullptr if all `seats` are taken. It does not outlive the feed.
  std::shared_ptr<const void> take_seat(std::size_t seats);
  std::size_t seats_taken() const { return taken_.load(std::memory_order_relaxed); }
  /// Sends until the feed is closed or the viewer has gone.
  void follow(WebStream& viewer);

  /// 0.8 MB a second.
  static constexpr std::size_t bytes_usual = 200'000;
  /// Minimum time between two events of a slot for a viewer.
  static constexpr std::chrono::milliseconds interval_usual{250};

 private:
  using Event = std::shared_ptr<const std::string>;
  struct Place {
    Event event;
    std::uint64_t version = 0;
  };
  struct Viewer {
    std::vector<std::uint64_t> seen;  ///< versions, by slot
    std::size_t next = 0;             ///< slot to check first, so that each has its turn
  };

  std::vector<Event> news(Viewer& viewer) const;
  void wait();

  std::size_t important_, bytes_at_once_;
  std::chrono::milliseconds interval_;
  std::atomic<std::size_t> taken_ = 0;
  mutable std::mutex mutex_;  ///< guards the members below
  std::condition_variable closed_;
  std::vector<Place> places_;
  std::uint64_t version_ = 0;
  Event last_;  ///< sent when it is closed
};

}  // namespace dmpc::apps
