// What a communicating thread with nothing to do does: it sleeps, the longer, the longer it has had nothing, or it does not.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>

namespace dmpc::nodes {

enum class Idle : std::uint8_t {
  sleep,  ///< where other threads want the core
  spin    ///< where it has one of its own: no frame waits for it to wake
};

/// Its own nodes call it when it is to act for them; it is frames of other ranks for which it has to look. It does not yield
/// before it sleeps: where others compute, a yield takes milliseconds, and who wakes goes before them. So every sleep's end takes
/// a core from one that computes, and sleeps of a few us would be no more than a poll with two switches of threads.
class Backoff {
 public:
  static constexpr std::chrono::nanoseconds shortest{30'000}, longest{100'000};
  /// After so long a silence sleeps are ten times as long.
  static constexpr std::chrono::nanoseconds silence{50'000'000};

  explicit Backoff(Idle idle = Idle::sleep) : idle_(idle) {}

  /// Something was done.
  void end() {
    next_ = shortest;
    slept_ = {};
  }
  /// How long to sleep now; zero for a yield.
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
