// Ctrl-C and SIGTERM as a stop token.
#pragma once

#include <atomic>
#include <stop_token>
#include <thread>

namespace dmpc::apps {

/// Thrown by a command that was stopped by a signal, after it has cleaned up. Exit status 130.
struct Interrupted {};
inline constexpr int interrupted_status = 130;

/// While it lives, SIGINT and SIGTERM are blocked in the thread that made it and in all threads that this one starts afterwards;
/// a thread of its own waits for them. So nothing of ours ever runs inside a signal handler. At most one at a time, made before
/// any other thread.
///
/// Thread safety: token() and requested() from any thread, the rest from the thread that made it.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  /// Stop is requested once a signal has come.
  std::stop_token token() const { return source_.get_token(); }
  bool requested() const { return source_.stop_requested(); }
  /// Throws Interrupted if a signal has come.
  void check() const;

  /// A scope in which a signal ends the process at once, saying so, with status 130: for long steps that look at no token and
  /// have nothing to clean up. Outside, a signal only requests the stop. Making one throws Interrupted if a signal has come
  /// before.
  class EndAtOnce {
   public:
    explicit EndAtOnce(Interrupt& interrupt);
    ~EndAtOnce() { interrupt_.end_at_once_ = false; }
    EndAtOnce(const EndAtOnce&) = delete;
    EndAtOnce& operator=(const EndAtOnce&) = delete;

   private:
    Interrupt& interrupt_;
  };

 private:
  void wait_for_signals(const std::stop_token& closing);

  std::stop_source source_;
  std::atomic<bool> end_at_once_ = false;
  std::jthread waiter_;
};

}  // namespace dmpc::apps
