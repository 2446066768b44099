#include "apps/frontend/system/interrupt.h"

#include <pthread.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <memory>
#include <string>
#include <system_error>
#include <utility>

#include "apps/frontend/line/exit_status.h"
#include "core/base/expect.h"

namespace dmpc::apps {

namespace {

/// All signals that end a process by default, except crashes and those that cannot be deferred.
constexpr std::array stopping = {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU, SIGALRM, SIGUSR1, SIGUSR2};

sigset_t stop_signals() {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : stopping) {
    sigaddset(&set, signal);
  }
  return set;
}

/// Whoever started the process wants the signal ignored, as nohup does.
bool is_ignored(int signal) {
  struct sigaction action {};
  return ::sigaction(signal, nullptr, &action) == 0 && (action.sa_flags & SA_SIGINFO) == 0 && action.sa_handler == SIG_IGN;
}

void change_mask(int how) {
  const sigset_t set = stop_signals();
  core::expect(pthread_sigmask(how, &set, nullptr) == 0, "the signal mask can be changed");
}

struct UnderWay {
  std::string path;
  bool is_folder;
};

/// A render has the most files in progress: a picture, counters, a trace, a page, a strip, a checkpoint, its lock, 32 heat
/// maps, and 8 layers.
constexpr std::size_t slot_count = 48;

/// The thread that takes a path out of its slot owns it.
std::array<std::atomic<UnderWay*>, slot_count> to_remove{};

/// Works without free memory.
void say(const char* words) { static_cast<void>(!::write(STDERR_FILENO, words, std::strlen(words))); }

/// A folder into which another thread still writes is not empty at once.
void remove_folder(const std::string& path) {
  std::error_code error;
  for (int tries = 0; tries < 100 && std::filesystem::remove_all(path, error) != 0; ++tries) {
  }
}

/// A folder that somebody has put in place of a file is left alone.
void remove_all_under_way() {
  for (std::atomic<UnderWay*>& slot : to_remove) {
    if (const std::unique_ptr<UnderWay> found{slot.exchange(nullptr)}) {
      found->is_folder ? remove_folder(found->path) : static_cast<void>(::unlink(found->path.c_str()));
    }
  }
}

}  // namespace

void remove_files_under_way() {
  for (std::atomic<UnderWay*>& slot : to_remove) {
    if (const UnderWay* const found = slot.exchange(nullptr)) {
      ::unlink(found->path.c_str());  // nothing is freed: the heap may be corrupt
    }
  }
}

RemovedAtOnce::RemovedAtOnce(const std::filesystem::path& path, Kind kind) : slot_(0) {
  auto owned = std::make_unique<UnderWay>(UnderWay{path.string(), kind == Kind::folder});
  for (UnderWay* free = nullptr; !to_remove[slot_].compare_exchange_strong(free, owned.get()); free = nullptr) {
    ++slot_;
    core::expect(slot_ < slot_count, "few files are under way at a time");
  }
  static_cast<void>(owned.release());
}

RemovedAtOnce::~RemovedAtOnce() { std::unique_ptr<UnderWay>(to_remove[slot_].exchange(nullptr)).reset(); }

Interrupt::Interrupt() : Interrupt(std::function<void()>()) {}

Interrupt::Interrupt(std::function<void()> look) : look_(std::move(look)) {
  change_mask(SIG_BLOCK);
  try {
    waiter_ = std::jthread([this](const std::stop_token& closing) { wait_for_signals(closing); });
  } catch (const std::system_error&) {
    throw core::CapacityError(
        "dmpc needs a thread that waits for signals, and this computer does not let it start one: ask for a higher limit (ulimit "
        "-u, pids.max of a container)");
  }
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

void Interrupt::stop_once() {
  if (source_.request_stop() && end_at_once_) {
    end_now();
  }
}

Interrupt::EndAtOnce::EndAtOnce(Interrupt& interrupt, Before before) : interrupt_(interrupt) {
  interrupt_.end_at_once_ = true;
  if (before == Before::counts && interrupt_.requested()) {
    interrupt_.end_at_once_ = false;
    throw Interrupted{};
  }
}

int Interrupt::next_signal() const {
  const sigset_t set = stop_signals();
  const timespec second{.tv_sec = 1, .tv_nsec = 0};
  int signal = 0;
  do {
    signal = look_ ? ::sigtimedwait(&set, nullptr, &second) : ::sigwaitinfo(&set, nullptr);
  } while (signal < 0 && errno == EINTR);
  return std::max(signal, 0);
}

void Interrupt::wait_for_signals(const std::stop_token& closing) {
  bool has_had_one = false;
  for (int signal = next_signal(); !closing.stop_requested(); signal = next_signal()) {
    if (signal == 0) {
      look_();
    } else if (signal == SIGUSR1 && takes_usr1_for_keep_) {
      is_keep_requested_ = true;
    } else if (!is_ignored(signal)) {
      source_.request_stop();
      if (std::exchange(has_had_one, true) || end_at_once_) {
        end_now();
      }
    }
  }
}

void Interrupt::end_now() const {
  remove_all_under_way();
  say("\ndmpc: interrupted, ");
  say(consequence());
  say("\n");
  ::_exit(interrupted_status);
}

}  // namespace dmpc::apps
