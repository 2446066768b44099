// How long a communicating thread with nothing to do sleeps: the longer, the longer it has had nothing.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>

namespace dmpc::nodes {

/// Its own nodes' packets wake it at once; it is frames of other ranks for which it has to look.
class Nap {
 public:
  /// Looks that follow each other with but a yield in between.
  static constexpr std::uint32_t looks_at_once = 16;
  static constexpr std::chrono::nanoseconds shortest{1'000}, longest{100'000};
  /// After so long a silence naps are ten times as long.
  static constexpr std::chrono::nanoseconds silence{50'000'000};

  /// Something was done.
  void end() {
    looks_ = 0;
    next_ = shortest;
    slept_ = {};
  }
  /// How long to sleep now; zero for a yield.
  std::chrono::nanoseconds next() {
    if (looks_ < looks_at_once) {
      ++looks_;
      return {};
    }
    const std::chrono::nanoseconds nap = next_;
    slept_ += nap;
    next_ = std::min(2 * next_, slept_ < silence ? longest : 10 * longest);
    return nap;
  }

 private:
  std::uint32_t looks_ = 0;
  std::chrono::nanoseconds next_ = shortest, slept_{};
};

}  // namespace dmpc::nodes
