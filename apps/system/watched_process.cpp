#include "apps/system/watched_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <csignal>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>

#include "apps/system/memory_file.h"
#include "apps/system/shortage.h"
#include "core/base/expect.h"

// NOLINTNEXTLINE(readability-redundant-declaration): POSIX leaves its declaration to the program
extern char** environ;

namespace dmpc::apps {
namespace {

constexpr useconds_t pause_microseconds = 1000;

/// Without the terminal's Ctrl-C, so that whoever waits for it decides.
int spawn(pid_t& id, const std::filesystem::path& program, std::vector<std::string>& words, const MemoryFile& errors) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, errors.descriptor(), STDERR_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  std::vector<char*> pointers;
  std::transform(words.begin(), words.end(), std::back_inserter(pointers), [](std::string& word) { return word.data(); });
  pointers.push_back(nullptr);
  const int error = ::posix_spawn(&id, program.c_str(), &actions, &attributes, pointers.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

/// Ended and waited for in the end, unless before.
class Process {
 public:
  Process(const std::filesystem::path& program, std::vector<std::string>& words, const MemoryFile& errors) {
    const int error = spawn(id_, program, words, errors);
    if (error != 0) {
      throw_if_short(error, program.string() + " cannot be started");
      throw core::InputError(program.string() + " cannot be started: " + std::strerror(error));
    }
  }
  ~Process() {
    if (!has_ended_) {
      ::kill(id_, SIGKILL);
      ::waitpid(id_, nullptr, 0);
    }
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// The exit status, once it has ended; that of a signal is below 0.
  std::optional<int> status() {
    int status = 0;
    if (::waitpid(id_, &status, WNOHANG) != id_) {
      return std::nullopt;
    }
    has_ended_ = true;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }
  std::size_t anonymous_bytes() const {
    std::ostringstream text;
    text << std::ifstream("/proc/" + std::to_string(id_) + "/status").rdbuf();
    return anonymous_bytes_in(text.str());
  }

 private:
  pid_t id_ = 0;
  bool has_ended_ = false;
};

}  // namespace

std::size_t anonymous_bytes_in(std::string_view status) {
  constexpr std::string_view name = "RssAnon:";
  const std::size_t at = status.find(name);
  if (at == std::string_view::npos) {
    return 0;
  }
  status.remove_prefix(at + name.size());
  status.remove_prefix(std::min(status.find_first_not_of(" \t"), status.size()));
  std::size_t kilobytes = 0;
  std::from_chars(status.data(), status.data() + status.size(), kilobytes);
  return kilobytes * 1024;
}

WatchedProcess watch_process(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                             const Interrupt& interrupt) {
  // The program may be called by a name that means another one to its child, as /proc/self/exe is.
  std::error_code unknown;
  const std::filesystem::path found = std::filesystem::canonical(program, unknown), path = unknown ? program : found;
  std::vector<std::string> words{path.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const MemoryFile errors;
  Process process(path, words, errors);
  WatchedProcess watched;
  std::optional<int> status;
  while (!(status = process.status())) {
    interrupt.check();
    if (const std::size_t bytes = process.anonymous_bytes(); bytes > watched.peak_anonymous_bytes.value_or(0)) {
      watched.peak_anonymous_bytes = bytes;
    }
    ::usleep(pause_microseconds);
  }
  watched.status = *status;
  watched.complaint = errors.bytes();
  return watched;
}

std::size_t peak_anonymous_bytes(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                                 const Interrupt& interrupt) {
  const WatchedProcess watched = watch_process(program, arguments, interrupt);
  if (watched.status != 0) {
    throw core::InputError(program.string() + " was to be watched and ended with status " + std::to_string(watched.status) +
                           (watched.complaint.empty() ? "" : ", saying: " + watched.complaint));
  }
  if (!watched.peak_anonymous_bytes) {
    throw core::InputError("the memory of " + program.string() + " could not be seen in /proc");
  }
  return *watched.peak_anonymous_bytes;
}

}  // namespace dmpc::apps
