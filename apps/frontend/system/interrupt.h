// Ctrl-C, SIGTERM and other terminating signals as a stop token, or as an immediate end.
#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <stop_token>
#include <thread>

namespace dmpc::apps {

/// Thrown by a command that was stopped by a signal, after it has cleaned up. Exit status 130.
struct Interrupted {};

/// During its lifetime, SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU, SIGALRM, SIGUSR1 and SIGUSR2 are blocked in the thread that
/// made it and in all threads that this thread starts afterwards; a separate thread waits for them, so no code of ours runs
/// inside a signal handler. The first signal requests a stop, the second ends the process at once with status 130. Signals that
/// were ignored when the process started, as SIGHUP is under nohup, stay ignored. At most one Interrupt exists at a time, and it
/// is made before any other thread.
///
/// Thread safety: any thread may call token(), requested(), stop_once(), set_consequence() and the functions about SIGUSR1; one
/// thread at a time may call the others.
class Interrupt {
 public:
  Interrupt();
  /// The thread that waits for signals calls look(), if it is set, about once a second. It must not throw.
  explicit Interrupt(std::function<void()> look);
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  /// The first signal requests a stop of this token.
  std::stop_token token() const { return source_.get_token(); }
  bool requested() const { return source_.stop_requested(); }
  /// Throws Interrupted if a signal has arrived.
  void check() const;

  /// From now on SIGUSR1 requests a checkpoint instead of stopping the process.
  void take_usr1_for_keep() { takes_usr1_for_keep_ = true; }
  /// Returns whether a checkpoint was requested since the last call.
  bool take_keep_request() { return is_keep_requested_.exchange(false); }

  /// Acts like the first signal, and does nothing after a signal; the next signal still counts as the first. There must be one
  /// caller only.
  void stop_once();

  /// Sets the end of the message about an interruption, which says what happens to the outputs; initially "nothing was written".
  /// `words` is a literal.
  void set_consequence(const char* words) { consequence_ = words; }
  const char* consequence() const { return consequence_; }

  /// A scope in which the first signal, too, ends the process at once, with a message and status 130: for long steps that check
  /// no token and have nothing to clean up except RemovedAtOnce files. The constructor throws Interrupted if a signal has arrived
  /// before, unless it is told to pass over it: then only a further signal ends the process.
  class EndAtOnce {
   public:
    enum class Before { counts, is_passed_over };
    explicit EndAtOnce(Interrupt& interrupt, Before before = Before::counts);
    ~EndAtOnce() { interrupt_.end_at_once_ = false; }
    EndAtOnce(const EndAtOnce&) = delete;
    EndAtOnce& operator=(const EndAtOnce&) = delete;

   private:
    Interrupt& interrupt_;
  };

 private:
  void wait_for_signals(const std::stop_token& closing);
  /// Returns 0 if there was no signal and a call of look() is due.
  int next_signal() const;
  [[noreturn]] void end_now() const;

  std::stop_source source_;
  std::atomic<const char*> consequence_ = "nothing was written";
  std::atomic<bool> end_at_once_ = false;
  std::atomic<bool> takes_usr1_for_keep_ = false, is_keep_requested_ = false;
  std::function<void()> look_;
  std::jthread waiter_;
};

/// During its lifetime, an immediate end removes the file at `path`, or, if it is our own folder, the folder with its contents.
/// The number of RemovedAtOnce at a time is limited, which is asserted.
///
/// Thread safety: none needed; both the thread that ends the process and the destructor take the path out of its slot, so only
/// one of them gets it.
class RemovedAtOnce {
 public:
  enum class Kind { file, folder };
  explicit RemovedAtOnce(const std::filesystem::path& path, Kind kind = Kind::file);
  ~RemovedAtOnce();
  RemovedAtOnce(const RemovedAtOnce&) = delete;
  RemovedAtOnce& operator=(const RemovedAtOnce&) = delete;

 private:
  std::size_t slot_;
};

/// Removes all RemovedAtOnce files when the process ends without destructors, also by abort(). It neither allocates nor frees
/// memory.
void remove_files_under_way();

}  // namespace dmpc::apps
