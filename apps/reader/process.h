// A process that reads foreign files for dmpc, with limited resources.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "apps/reader/budget.h"
#include "apps/reader/line.h"

namespace dmpc::apps {

/// The reader has ended early: by a signal, a limit, or invalid messages. The text continues "the reader of PLY files ...".
struct ReaderDeath : core::InputError {
  using core::InputError::InputError;
};

/// The destructor ends the process and waits for it.
class ReaderProcess {
 public:
  /// Starts the program and waits until it is ready. It may use `memory_bytes` beyond its memory at the start, and from then on
  /// the time of `budget`, which outlives it. Limits that this computer cannot set are reported once. Throws core::InternalError
  /// if the program is missing or does not get ready, ComputerCapacityError if this computer does not let it, core::InputError if
  /// it is confined by less than the budget's sandbox asks for.
  ReaderProcess(const std::string& program, std::uint64_t memory_bytes, ReadingBudget& budget);
  ~ReaderProcess();
  ReaderProcess(const ReaderProcess&) = delete;
  ReaderProcess& operator=(const ReaderProcess&) = delete;

  /// The bytes of a file extend its time. Throws ReaderDeath if it has ended, or if no time is left.
  void send(Saying saying, const Packer& fields = {}, const Descriptor* file = nullptr, std::uint64_t file_bytes = 0);
  /// After a request, as many messages as needed; waits while its buffer is full. Throws ReaderDeath if it has ended.
  void send_bytes(std::span<const std::byte> bytes);
  /// The next message. Throws ReaderDeath if it has ended or takes too long, core::CapacityError if its memory is exhausted.
  Message receive();
  /// Copies the memory of the process at `address` into `room`. Changes that the reader makes meanwhile may show; later ones do
  /// not. Returns false if there are not so many bytes, if the data would exceed its memory limit when each byte becomes `growth`
  /// bytes, or if this computer does not let dmpc read the memory.
  bool copy(std::uint64_t address, std::span<std::byte> room, std::uint64_t growth = 1);

 private:
  void start(const std::string& program, const Descriptor& its_end, int errors);
  Confinement hear_that_it_is_ready();
  void check(const Confinement& confinement);
  void stop();
  /// Sets the time limit in the system.
  void allow();
  /// Processor time since its start.
  ReadingBudget::Time taken() const;
  void wait_for_message();
  [[noreturn]] void end(const char* unless_by_signal);

  ReadingBudget starting_{ReaderLimits{}};  ///< the start depends on the computer's load, not on the files' budget
  ReadingBudget* budget_ = &starting_;
  std::uint64_t memory_bytes_, grown_bytes_ = 0;
  pid_t id_ = -1;
  Line line_;
  ReadingBudget::Time taken_to_start_{};
};

}  // namespace dmpc::apps
