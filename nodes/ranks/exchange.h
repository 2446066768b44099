// What a rank does while it waits for others: receives and sends frames, sends heartbeats, and sleeps.
#pragma once

#include <sched.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <thread>

#include "nodes/ranks/backoff.h"
#include "nodes/ranks/rank_links.h"

namespace dmpc::nodes {

/// Takes turns until is_done().
using Wait = std::function<void(const std::function<bool()>& is_done)>;

/// Thread safety: belongs to the communicating thread.
class Exchange {
 public:
  /// `links` outlive this.
  explicit Exchange(RankLinks& links) : links_(&links), backoff_(links.idle()) {}

  /// Receives and sends what there is, as RankLinks do, with act() in between; calls sleep(time) if there was nothing and act()
  /// returned false.
  template <class Receive, class Act, class Sleep>
  void turn(const Receive& receive, const Act& act, const Sleep& sleep) {
    bool has_moved = links_->take(receive);
    has_moved = act() || has_moved;
    has_moved = links_->flush() || has_moved;
    if (!has_moved || ++turns_ % turns_a_look == 0) {
      links_->look_after();
    }
    has_moved ? backoff_.end() : rest(sleep);
  }
  /// With nothing else to do.
  template <class Receive>
  void turn(const Receive& receive) {
    turn(
        receive, [] { return false; }, [](std::chrono::nanoseconds time) { std::this_thread::sleep_for(time); });
  }
  template <class Receive, class IsDone>
  void turn_until(const IsDone& is_done, const Receive& receive) {
    while (!is_done()) {
      turn(receive);
    }
  }
  /// To be called when other threads, which moved frames, do so no more: soon something arrives.
  void end_backoff() { backoff_.end(); }

 private:
  /// The number of turns of a busy thread between two checks for silent ranks.
  static constexpr std::uint32_t turns_a_look = 256;

  template <class Sleep>
  void rest(const Sleep& sleep) {
    const std::chrono::nanoseconds time = backoff_.next();
    if (time == time.zero()) {
      sched_yield();
    } else {
      sleep(time);
    }
  }

  RankLinks* links_;
  Backoff backoff_;
  std::uint32_t turns_ = 0;
};

}  // namespace dmpc::nodes
