#include "apps/edge/system/child_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <iterator>
#include <utility>

#include "apps/edge/system/shortage.h"
#include "core/base/expect.h"

// NOLINTNEXTLINE(readability-redundant-declaration): POSIX leaves its declaration to the program
extern char** environ;

namespace dmpc::apps {
namespace {

/// What the child is given.
class Surroundings {
 public:
  Surroundings(const ChildSettings& settings, int errors) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawnattr_init(&attributes_);
    posix_spawn_file_actions_addchdir_np(&actions_, settings.folder.c_str());
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&actions_, errors, STDERR_FILENO);
    sigset_t signals;
    sigemptyset(&signals);
    posix_spawnattr_setsigmask(&attributes_, &signals);
    sigaddset(&signals, SIGPIPE);
    sigaddset(&signals, SIGXFSZ);
    posix_spawnattr_setsigdefault(&attributes_, &signals);
    const int group = settings.gets_ctrl_c ? 0 : POSIX_SPAWN_SETPGROUP;
    posix_spawnattr_setflags(&attributes_, static_cast<short>(POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | group));
  }
  ~Surroundings() {
    posix_spawnattr_destroy(&attributes_);
    posix_spawn_file_actions_destroy(&actions_);
  }
  Surroundings(const Surroundings&) = delete;
  Surroundings& operator=(const Surroundings&) = delete;

  /// An error's number, or 0.
  int spawn(pid_t& id, std::vector<std::string> words) const {
    std::vector<char*> pointers;
    std::transform(words.begin(), words.end(), std::back_inserter(pointers), [](std::string& word) { return word.data(); });
    pointers.push_back(nullptr);
    return ::posix_spawnp(&id, pointers.front(), &actions_, &attributes_, pointers.data(), environ);
  }

 private:
  posix_spawn_file_actions_t actions_{};
  posix_spawnattr_t attributes_{};
};

}  // namespace

ChildProcess::ChildProcess(const ChildSettings& settings) {
  std::vector<std::string> words{settings.program};
  words.insert(words.end(), settings.arguments.begin(), settings.arguments.end());
  if (const int error = Surroundings(settings, errors_.descriptor()).spawn(id_, std::move(words)); error != 0) {
    throw_if_short(error, settings.program + " cannot be started");
    throw core::InputError(settings.program + " cannot be started: " + std::strerror(error));
  }
}

ChildProcess::~ChildProcess() {
  if (!status_) {
    ::kill(id_, SIGKILL);
    ::waitpid(id_, nullptr, 0);
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
