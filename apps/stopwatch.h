// Clocks, lap by lap.
#pragma once

#include <time.h>

#include <chrono>
#include <utility>

namespace dmpc::apps {

/// Wall clock. Runs from its making. Not thread-safe.
class Stopwatch {
 public:
  /// Seconds since the last call or the making.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// The processor time of the thread that makes and asks it: what others do on the machine meanwhile counts little. Runs from its
/// making.
class ThreadStopwatch {
 public:
  /// Seconds since the last call or the making.
  double lap() {
    const double now = seconds();
    return now - std::exchange(last_, now);
  }

 private:
  static double seconds() {
    timespec time{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }

  double last_ = seconds();
};

}  // namespace dmpc::apps
