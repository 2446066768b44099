#include "apps/interrupt.h"

#include <pthread.h>
#include <unistd.h>

#include <csignal>
#include <string_view>

#include "core/expect.h"

namespace dmpc::apps {

namespace {

sigset_t stop_signals() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  return set;
}

void change_mask(int how) {
  const sigset_t set = stop_signals();
  core::expect(pthread_sigmask(how, &set, nullptr) == 0, "the signal mask can be changed");
}

[[noreturn]] void end_now() {
  constexpr std::string_view message = "\ndmpc: interrupted, nothing was written\n";
  static_cast<void>(!::write(STDERR_FILENO, message.data(), message.size()));
  ::_exit(interrupted_status);
}

}  // namespace

Interrupt::Interrupt() {
  change_mask(SIG_BLOCK);
  waiter_ = std::jthread([this](const std::stop_token& closing) { wait_for_signals(closing); });
}

Interrupt::~Interrupt() {
  waiter_.request_stop();
  pthread_kill(waiter_.native_handle(), SIGTERM);  // NOLINT(bugprone-bad-signal-to-kill-thread): it wakes the waiter
  waiter_.join();
  change_mask(SIG_UNBLOCK);
}

void Interrupt::check() const {
  if (requested()) {
    throw Interrupted{};
  }
}

Interrupt::EndAtOnce::EndAtOnce(Interrupt& interrupt) : interrupt_(interrupt) {
  interrupt_.end_at_once_ = true;
  if (interrupt_.requested()) {
    interrupt_.end_at_once_ = false;
    throw Interrupted{};
  }
}

void Interrupt::wait_for_signals(const std::stop_token& closing) {
  const sigset_t set = stop_signals();
  int signal = 0;
  while (sigwait(&set, &signal) == 0 && !closing.stop_requested()) {
    source_.request_stop();
    if (end_at_once_) {
      end_now();
    }
  }
}

}  // namespace dmpc::apps
