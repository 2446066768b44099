// What a rank does while it waits for others, before and after a run: takes and sends frames, shows that it lives, and sleeps.
#pragma once

#include <sched.h>

#include <chrono>
#include <cstdint>
#include <thread>

#include "nodes/ranks/nap.h"
#include "nodes/ranks/rank_links.h"

namespace dmpc::nodes {

/// Thread safety: belongs to the communicating thread.
class Exchange {
 public:
  /// `links` outlive this.
  explicit Exchange(RankLinks& links) : links_(&links), nap_(links.idle()) {}

  /// Takes and sends what there is, as RankLinks do; sleeps if that is nothing.
  template <class Receive>
  void turn(const Receive& receive) {
    bool has_moved = links_->take(receive);
    has_moved = links_->flush() || has_moved;
    if (!has_moved || ++turns_ % turns_a_look == 0) {
      links_->look_after();
    }
    has_moved ? nap_.end() : rest();
  }
  template <class Receive, class IsDone>
  void turn_until(const IsDone& is_done, const Receive& receive) {
    while (!is_done()) {
      turn(receive);
    }
  }

 private:
  static constexpr std::uint32_t turns_a_look = 256;

  void rest() {
    const std::chrono::nanoseconds time = nap_.next();
    if (time == time.zero()) {
      sched_yield();
    } else {
      std::this_thread::sleep_for(time);
    }
  }

  RankLinks* links_;
  Nap nap_;
  std::uint32_t turns_ = 0;
};

}  // namespace dmpc::nodes
