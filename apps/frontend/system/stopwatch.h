// Stopwatches, with lap times.
#pragma once

#include <time.h>

#include <chrono>
#include <utility>

namespace dmpc::apps {

/// Measures wall clock time from construction on. Not thread-safe.
class Stopwatch {
 public:
  /// Returns the seconds since the last call or construction.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Measures processor time, which other processes hardly influence, from construction on.
class ProcessorStopwatch {
 public:
  /// CLOCK_PROCESS_CPUTIME_ID: all threads together; CLOCK_THREAD_CPUTIME_ID: the thread that makes and reads it.
  explicit ProcessorStopwatch(clockid_t clock) : clock_(clock), last_(seconds()) {}

  /// Returns the seconds since the last call or construction.
  double lap() {
    const double now = seconds();
    return now - std::exchange(last_, now);
  }

 private:
  double seconds() const {
    timespec time{};
    ::clock_gettime(clock_, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }

  clockid_t clock_;
  double last_;
};

struct Times {
  double wall_seconds = 0;
  double processor_seconds = 0;  ///< sum over all threads of the process
};

/// Reads both clocks at once. Starts on construction.
class DoubleStopwatch {
 public:
  Times lap() { return {wall_.lap(), processor_.lap()}; }

 private:
  Stopwatch wall_;
  ProcessorStopwatch processor_{CLOCK_PROCESS_CPUTIME_ID};
};

}  // namespace dmpc::apps
