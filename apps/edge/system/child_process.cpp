#include "apps/edge/system/child_process.h"

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

#include "apps/edge/system/descriptor.h"
#include "apps/edge/system/shortage.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

/// A pipe that no program inherits, by which a child says why it could not become the program: nothing if it did.
struct Complaint {
  Descriptor its, ours;

  Complaint() {
    std::array<int, 2> ends{-1, -1};
    if (::pipe2(ends.data(), O_CLOEXEC) == 0) {
      ours = Descriptor(ends[0]);
      its = Descriptor(ends[1]);
    }
  }
  /// An error's number, or 0.
  int hear() {
    its = Descriptor();
    int error = 0;
    while (::read(ours.number(), &error, sizeof(error)) < 0 && errno == EINTR) {
    }
    return error;
  }
};

/// What a child has before it is the program: made before the fork, since it may take no memory between.
struct Start {
  std::vector<std::string> words;
  std::vector<char*> pointers;
  const char* folder;
  int input, output, errors;
  bool has_own_group;
  pid_t parent = ::getpid();

  Start(const ChildSettings& settings, int its_errors)
      : words{settings.program},
        folder(settings.folder.c_str()),
        input(settings.input),
        output(settings.output),
        errors(its_errors),
        has_own_group(!settings.gets_ctrl_c) {
    words.insert(words.end(), settings.arguments.begin(), settings.arguments.end());
    std::transform(words.begin(), words.end(), std::back_inserter(pointers), [](std::string& word) { return word.data(); });
    pointers.push_back(nullptr);
  }
};

/// `file`, or nothing, becomes the child's `number`.
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

/// In the child. The thread that started it waits for it, and ends no sooner: what the child gets is the parent's death.
[[noreturn]] void become(const Start& start, int complaint) {
  const bool is_tied = ::prctl(PR_SET_PDEATHSIG, SIGTERM) == 0;
  if (::getppid() != start.parent) {
    ::_exit(0);  // it has died before
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

ChildProcess::ChildProcess(const ChildSettings& settings) {
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
    wait_for_end();
  }
}

void ChildProcess::wait_for_end() const {
  while (id_ > 0 && ::waitpid(id_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

std::optional<int> ChildProcess::status() {
  int status = 0;
  if (!status_ && ::waitpid(id_, &status, WNOHANG) == id_) {
    take(status);
  }
  return status_;
}

int ChildProcess::wait() {
  int status = 0;
  while (!status_ && ::waitpid(id_, &status, 0) < 0) {
    core::expect(errno == EINTR, "a child can be waited for");
  }
  return status_ ? *status_ : take(status);
}

int ChildProcess::take(int status) {
  status_ = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  return *status_;
}

}  // namespace dmpc::apps
