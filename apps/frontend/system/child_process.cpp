#include "apps/frontend/system/child_process.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <iterator>

#include "apps/frontend/system/descriptor.h"
#include "apps/frontend/system/resource_exhaustion.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

/// A pipe that no program inherits, through which a child reports why it could not become the program. Nothing is written if it
/// did.
struct Complaint {
  Descriptor its, ours;

  Complaint() {
    std::array<int, 2> ends{-1, -1};
    if (::pipe2(ends.data(), O_CLOEXEC) == 0) {
      ours = Descriptor(ends[0]);
      its = Descriptor(ends[1]);
    }
  }
  /// Returns an error's number, or 0.
  int hear() {
    its = Descriptor();
    int error = 0;
    while (::read(ours.number(), &error, sizeof(error)) < 0 && errno == EINTR) {
    }
    return error;
  }
};

/// What a child needs before it becomes the program: made before the fork, since the child may not allocate memory.
struct Start {
  std::vector<std::string> words;
  std::vector<char*> pointers;
  const char* folder;
  int input, output, errors;
  bool has_own_group;
  int death_signal;
  pid_t parent = ::getpid();

  Start(const ChildSettings& settings, int its_errors)
      : words{settings.program},
        folder(settings.folder.c_str()),
        input(settings.input),
        output(settings.output),
        errors(its_errors),
        has_own_group(!settings.gets_ctrl_c),
        death_signal(settings.leaves_nothing ? SIGKILL : SIGTERM) {
    words.insert(words.end(), settings.arguments.begin(), settings.arguments.end());
    std::transform(words.begin(), words.end(), std::back_inserter(pointers), [](std::string& word) { return word.data(); });
    pointers.push_back(nullptr);
  }
};

/// Makes `file`, or an opened file if there is none, the child's descriptor `number`.
bool opens_as(int number, int file, int mode) {
  if (file >= 0) {
    return file == number ? ::fcntl(file, F_SETFD, 0) == 0 : ::dup2(file, number) >= 0;
  }
  const int opened = ::open("/dev/null", mode);
  return opened >= 0 && ::dup2(opened, number) >= 0 && (opened <= STDERR_FILENO || ::close(opened) == 0);
}

bool unblocks_signals() {
  sigset_t none;
  sigemptyset(&none);
  ::signal(SIGPIPE, SIG_DFL);
  ::signal(SIGXFSZ, SIG_DFL);
  return ::sigprocmask(SIG_SETMASK, &none, nullptr) == 0;
}

/// Runs in the child. The thread that started it waits for it and does not end before: the child receives a signal at that
/// thread's death.
[[noreturn]] void become(const Start& start, int complaint) {
  const bool is_tied = ::prctl(PR_SET_PDEATHSIG, start.death_signal) == 0;
  if (::getppid() != start.parent) {
    ::_exit(0);  // the parent has died before
  }
  if (is_tied && ::chdir(start.folder) == 0 && opens_as(STDIN_FILENO, start.input, O_RDONLY) &&
      opens_as(STDOUT_FILENO, start.output, O_WRONLY) && ::dup2(start.errors, STDERR_FILENO) >= 0 &&
      (!start.has_own_group || ::setpgid(0, 0) == 0) && unblocks_signals()) {
    ::execvp(start.pointers.front(), start.pointers.data());
  }
  const int error = errno;
  static_cast<void>(!::write(complaint, &error, sizeof(error)));
  ::_exit(127);
}

}  // namespace

ChildProcess::ChildProcess(const ChildSettings& settings) : leaves_nothing_(settings.leaves_nothing) {
  core::expect(!leaves_nothing_ || !settings.gets_ctrl_c, "what leaves nothing has a group of its own");
  const Start start(settings, errors_.descriptor());
  Complaint complaint;
  int error = complaint.ours.is_open() ? 0 : errno;
  if (error == 0 && (id_ = ::fork()) == 0) {
    become(start, complaint.its.number());
  }
  error = error != 0 ? error : id_ < 0 ? errno : complaint.hear();
  if (error != 0) {
    wait_for_end();
    throw_if_short(error, settings.program + " cannot be started");
    throw core::InputError(settings.program + " cannot be started: " + std::strerror(error));
  }
}

ChildProcess::~ChildProcess() {
  if (!status_) {
    ::kill(id_, SIGKILL);
    has_ended(0);
    take_end();
  }
}

void ChildProcess::wait_for_end() const {
  while (id_ > 0 && ::waitpid(id_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

/// The child is still waited for: until then no other process gets its number, or its group's.
bool ChildProcess::has_ended(int options) const {
  siginfo_t info{};
  int waited = 0;
  do {
    waited = ::waitid(P_PID, static_cast<id_t>(id_), &info, WEXITED | WNOWAIT | options);
  } while (waited < 0 && errno == EINTR);
  return waited == 0 && info.si_pid == id_;
}

void ChildProcess::end_group() const {
  if (leaves_nothing_) {
    ::kill(-id_, SIGKILL);
  }
}

std::optional<int> ChildProcess::status() {
  if (!status_ && has_ended(WNOHANG)) {
    take_end();
  }
  return status_;
}

int ChildProcess::wait() {
  if (!status_) {
    core::expect(has_ended(0), "a child can be waited for");
    take_end();
  }
  return *status_;
}

int ChildProcess::take_end() {
  end_group();
  int status = 0;
  while (::waitpid(id_, &status, 0) < 0 && errno == EINTR) {
  }
  status_ = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  return *status_;
}

}  // namespace dmpc::apps
