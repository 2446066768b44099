// The idle strategy of a communicating thread: it sleeps, the longer, the longer it has had nothing to do, or it spins.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>

namespace dmpc::nodes {

enum class Idle : std::uint8_t {
  sleep,  ///< where other threads want the core
  spin    ///< if it has a core of its own: no frame waits for it to wake
};

/// Its own nodes wake it when it is to act for them; it has to poll for frames of other ranks. It does not yield before it
/// sleeps: if others compute, a yield takes milliseconds, while a thread that wakes goes before them. So the end of every sleep
/// takes a core from a computing thread, and sleeps of a few us would be no more than a poll with two switches of threads.
class Backoff {
 public:
  static constexpr std::chrono::nanoseconds shortest{30'000}, longest{100'000};
  /// After this time without work sleeps are ten times as long.
  static constexpr std::chrono::nanoseconds silence{50'000'000};

  explicit Backoff(Idle idle = Idle::sleep) : idle_(idle) {}

  /// To be called when something was done.
  void end() {
    next_ = shortest;
    slept_ = {};
  }
  /// The duration of the next sleep; zero for a yield.
  std::chrono::nanoseconds next() {
    if (idle_ == Idle::spin) {
      return {};
    }
    const std::chrono::nanoseconds backoff = next_;
    slept_ += backoff;
    next_ = std::min(2 * next_, slept_ < silence ? longest : 10 * longest);
    return backoff;
  }

 private:
  Idle idle_;
  std::chrono::nanoseconds next_ = shortest, slept_{};
};

}  // namespace dmpc::nodes
