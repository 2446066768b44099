#include "apps/frontend/system/scratch_folder.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>

// NOLINTNEXTLINE(readability-redundant-declaration): POSIX leaves its declaration to the program
extern char** environ;

namespace dmpc::apps {
namespace {

/// It retries, as children that still write to the folder end at the same time.
constexpr const char* script = R"(trap '' INT TERM HUP QUIT
read -r nothing
tries=0
while [ -e "$1" ] && [ $tries -lt 50 ]; do
  /bin/rm -rf -- "$1"
  tries=$((tries + 1))
  [ ! -e "$1" ] || /bin/sleep 0.1
done)";

int spawn(pid_t& id, const std::string& folder, int life) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, life, STDIN_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addclosefrom_np(&actions, STDERR_FILENO + 1);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);  // keeps the terminal's Ctrl-C from it
  std::array<std::string, 5> words{"/bin/sh", "-c", script, "dmpc-heir", folder};
  std::array<char*, 6> pointers{words[0].data(), words[1].data(), words[2].data(), words[3].data(), words[4].data(), nullptr};
  const int error = ::posix_spawn(&id, pointers[0], &actions, &attributes, pointers.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

}  // namespace

FolderHeir::FolderHeir(const std::filesystem::path& folder) {
  std::array<int, 2> ends{-1, -1};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    return;
  }
  const Descriptor its(ends[0]);
  life_ = Descriptor(ends[1]);
  if (spawn(id_, folder.string(), its.number()) != 0) {
    id_ = -1;
  }
}

FolderHeir::~FolderHeir() {
  if (id_ > 0) {
    ::kill(id_, SIGKILL);
    while (::waitpid(id_, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
}

}  // namespace dmpc::apps
