// A process that reads foreign files for dmpc, with limits on what it may take.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <string>

#include "apps/reader/line.h"

namespace dmpc::apps {

/// What it may take. Grows with the bytes of the files that it is given.
struct ReaderLimits {
  std::uint64_t seconds = 10;              ///< of processor time
  std::uint64_t bytes_a_second = 500'000;  ///< so many more bytes of files, one more second
  bool each_file = false;                  ///< all that is for each file anew, else for all files together
  std::uint64_t wall_factor = 30;  ///< so many times the processor time may pass on the wall: others want the processor, too
};

/// It has ended before its time: by a signal, by a limit, or by saying nonsense. The text goes on "the reader of PLY files ...".
struct ReaderDeath : core::InputError {
  using core::InputError::InputError;
};

/// Ended and waited for in the end.
class ReaderProcess {
 public:
  /// Starts the program and waits until it is ready; it may take so much memory beside what it has at the start. Throws
  /// core::InternalError if there is no such program or if it does not get ready, ComputerRoomError if this computer lets it not.
  ReaderProcess(const std::string& program, std::uint64_t memory_bytes, const ReaderLimits& limits);
  ~ReaderProcess();
  ReaderProcess(const ReaderProcess&) = delete;
  ReaderProcess& operator=(const ReaderProcess&) = delete;

  /// With a file, its bytes give it more time.
  void send(Saying saying, const Packer& fields = {}, const Descriptor* file = nullptr, std::uint64_t file_bytes = 0);
  /// The next message. Throws ReaderDeath if it has ended or takes too long, core::RoomError if its memory ended.
  Message receive();

  /// Whether the kernel refuses it all but few calls.
  bool is_filtered() const { return is_filtered_; }

 private:
  using Clock = std::chrono::steady_clock;

  Clock::duration wall_time() const { return std::chrono::seconds(seconds_ * limits_.wall_factor); }

  void start(const std::string& program, const Descriptor& its_end, int errors);
  void hear_that_it_is_ready();
  void allow(std::uint64_t file_bytes);
  /// Seconds of processor time, rounded up.
  std::uint64_t seconds_taken() const;
  void wait_for_message();
  [[noreturn]] void end(const char* unless_by_signal);

  ReaderLimits limits_;
  std::uint64_t memory_bytes_;
  pid_t id_ = -1;
  Line line_;
  std::uint64_t seconds_ = 0, file_bytes_ = 0, seconds_before_ = 0;
  Clock::duration waited_{};  ///< for its messages; what dmpc does meanwhile is not its time
  bool is_filtered_ = false;
};

}  // namespace dmpc::apps
