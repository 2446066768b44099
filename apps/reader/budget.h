// Limits for reading a scene or its pictures, and the confinement of the readers.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>

#include "apps/reader/confinement.h"

namespace dmpc::apps {

/// A basic amount, and more for each byte of the files that are read.
struct ReaderLimits {
  std::uint64_t seconds = 10;              ///< processor time
  std::uint64_t bytes_a_second = 500'000;  ///< one more second for this many more bytes of files
  std::uint64_t wall_factor = 30;          ///< limit of wall clock over processor time: other processes want the processor, too
  std::uint64_t texture_bytes_max = 0;     ///< for all textures of a scene, with their levels; 0: as much memory as there is
  Sandbox sandbox = Sandbox::available;
};

/// One budget for all processes that read a scene, one after the other or concurrently, and for dmpc's answers to them. Bytes of
/// files extend it, once per file; requests, further small files, and further processes do not. Not thread-safe.
class ReadingBudget {
 public:
  using Time = std::chrono::nanoseconds;

  explicit ReadingBudget(const ReaderLimits& limits) : limits_(limits) {}

  void add_bytes(std::uint64_t bytes) { bytes_ += bytes; }
  /// Adds processor time that an ended process or dmpc itself has used.
  void spend(Time time) { spent_ += time; }
  /// Adds wall-clock time.
  void wait(Time time) { waited_ += time; }

  const ReaderLimits& limits() const { return limits_; }
  /// The whole budget, in seconds of processor time.
  std::uint64_t seconds() const { return limits_.seconds + bytes_ / std::max<std::uint64_t>(limits_.bytes_a_second, 1); }
  std::uint64_t wall_seconds() const { return seconds() * limits_.wall_factor; }
  /// Zero or negative if it is used up.
  Time left() const { return std::chrono::seconds(seconds()) - spent_; }
  Time wall_left() const { return std::chrono::seconds(wall_seconds()) - waited_; }

 private:
  ReaderLimits limits_;
  std::uint64_t bytes_ = 0;
  Time spent_{}, waited_{};
};

}  // namespace dmpc::apps
