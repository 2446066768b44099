// The progress of a render, on one line of a terminal.
#pragma once

#include <chrono>
#include <cstdint>
#include <iosfwd>
#include <string>

namespace dmpc::apps {

/// Returns "1:02:03" or "2:03".
std::string clock_text(double seconds);

/// Returns " 42 % [========>           ]  123456 pixels/s, 0:07 left", without a line end; `unit` is what is counted. `done` <=
/// `total`, `total` > 0, `seconds` >= 0 since the start. Unknown values are left out: the time left is shown from one second on,
/// once a hundredth is done or ten seconds have passed.
std::string progress_line(std::uint64_t done, std::uint64_t total, double seconds, const std::string& unit = "pixels");

/// Whether stderr is a terminal.
bool stderr_is_terminal();

/// Suppresses all Progress in this process: for --quiet, called first.
void silence_progress();

/// Rewrites its line at most ten times a second and removes it at the end. Not thread-safe.
class Progress {
 public:
  /// Prints nothing unless `shown`; otherwise `label`, if there is one, is printed at once and before every line. `output`
  /// outlives it.
  Progress(std::ostream& output, bool shown, std::string label = "", std::string unit = "pixels");
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// If less is done than before, a new stretch with its own total and rate has begun.
  void update(std::uint64_t done, std::uint64_t total);
  /// As above under another label, without a rate.
  void show(const std::string& label, std::uint64_t done, std::uint64_t total);

 private:
  /// Returns whether another line is due.
  bool is_due();

  using Clock = std::chrono::steady_clock;

  std::ostream& output_;
  bool shown_;
  std::string label_, unit_;
  std::uint64_t done_ = 0;
  Clock::time_point start_;
  Clock::time_point next_;  ///< earliest time for the next line
};

}  // namespace dmpc::apps
