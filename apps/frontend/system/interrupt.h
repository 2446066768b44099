// Ctrl-C, SIGTERM and other signals that end a process as a stop token, or as the end at once.
#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <stop_token>
#include <thread>

#include "apps/frontend/line/exit_status.h"

namespace dmpc::apps {

/// Thrown by a command that was stopped by a signal, after it has cleaned up. Exit status 130.
struct Interrupted {};

/// While it lives, SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU, SIGALRM, SIGUSR1 and SIGUSR2 are blocked in the thread that made it
/// and in all threads that this one starts afterwards; a thread of its own waits for them. So none of these ever runs inside a
/// signal handler. The first signal requests a stop, the second ends the process at once with status 130. One that was ignored
/// when the process started, as SIGHUP is under nohup, still is. At most one at a time, made before any other thread.
///
/// Thread safety: token(), requested(), stop_once(), set_consequence() and what is about SIGUSR1 from any thread, the rest from
/// one at a time.
class Interrupt {
 public:
  Interrupt();
  /// The thread that waits for signals calls look(), if there is one, about once a second. It must not throw.
  explicit Interrupt(std::function<void()> look);
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  /// Stop is requested once a signal has come.
  std::stop_token token() const { return source_.get_token(); }
  bool requested() const { return source_.stop_requested(); }
  /// Throws Interrupted if a signal has come.
  void check() const;

  /// From now on SIGUSR1 stops nothing, but asks that what is done be kept.
  void take_usr1_for_keep() { takes_usr1_for_keep_ = true; }
  /// Whether that has been asked since the last call.
  bool take_keep_request() { return is_keep_requested_.exchange(false); }

  /// Means what the first signal means, and nothing where one has come; one that comes after it is still the first. Who asks for
  /// it knows of no other that does.
  void stop_once();

  /// What an interruption from now on means for the outputs, as its message ends; at first "nothing was written". `words` is a
  /// literal.
  void set_consequence(const char* words) { consequence_ = words; }
  const char* consequence() const { return consequence_; }

  /// A scope in which the first signal, too, ends the process at once, saying so, with status 130: for long steps that look at
  /// no token and have nothing to clean up but files that are RemovedAtOnce. Making one throws Interrupted if a signal has come
  /// before, unless that is to be passed over: then only a further one ends the process.
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
  /// 0 if there was none, and a look was due.
  int next_signal() const;
  [[noreturn]] void end_now() const;

  std::stop_source source_;
  std::atomic<const char*> consequence_ = "nothing was written";
  std::atomic<bool> end_at_once_ = false;
  std::atomic<bool> takes_usr1_for_keep_ = false, is_keep_requested_ = false;
  std::function<void()> look_;
  std::jthread waiter_;
};

/// While it lives, an end at once removes the file at `path` if there is one, or the folder with all in it if it is one's own.
/// There are few at a
/// time, which is asserted.
///
/// Thread safety: none needed; the thread that ends the process takes the path out of its slot, and so does the destructor: only
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

/// Removes all files that are RemovedAtOnce, for an end without destructors, also by abort(). Takes and frees no memory.
void remove_files_under_way();

}  // namespace dmpc::apps
