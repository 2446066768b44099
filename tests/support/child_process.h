// A program run by a test, with what it said.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/expect.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::tests {

/// Started by its making; stdin is empty, stderr goes to a file, and so does stdout unless another place is given.
class ChildProcess {
 public:
  explicit ChildProcess(std::vector<std::string> command, const std::filesystem::path& standard_output = {}) {
    std::vector<char*> arguments;
    arguments.reserve(command.size() + 1);
    for (std::string& word : command) {
      arguments.push_back(word.data());
    }
    arguments.push_back(nullptr);
    std::fflush(stdout);  // else the child writes it once more
    id_ = ::fork();
    if (id_ == 0) {
      redirect("/dev/null", "r", stdin);
      redirect(standard_output.empty() ? folder_ / "output" : standard_output, "w", stdout);
      redirect(folder_ / "errors", "w", stderr);
      ::execv(arguments.front(), arguments.data());
      ::_exit(127);
    }
    core::expect(id_ > 0, "a process can be started");
  }
  ~ChildProcess() {
    if (running_) {
      ::kill(id_, SIGKILL);
      ::waitpid(id_, nullptr, 0);
    }
  }
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Waits until the program's first thread blocks `signal`, that is, takes it in its own way; false after a minute without.
  bool blocks(int signal) const {
    for (int attempt = 0; attempt < 6000; ++attempt) {
      const std::string state = file_text("/proc/" + std::to_string(id_) + "/status");
      const std::size_t mask = state.find("SigBlk:");
      if (mask != std::string::npos && (std::stoull(state.substr(mask + 7), nullptr, 16) >> (signal - 1) & 1U) != 0) {
        return true;
      }
      ::usleep(10'000);
    }
    return false;
  }
  pid_t id() const { return id_; }
  void send(int signal) const { ::kill(id_, signal); }
  /// Waits for the end; the exit status, or 1000 + signal if a signal ended it.
  int status() {
    int status = 0;
    core::expect(::waitpid(id_, &status, 0) == id_, "a child can be waited for");
    running_ = false;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
  }
  std::string output() const { return file_text(folder_ / "output"); }
  std::string errors() const { return file_text(folder_ / "errors"); }

 private:
  static void redirect(const std::filesystem::path& path, const char* mode, std::FILE* stream) {
    if (std::freopen(path.c_str(), mode, stream) == nullptr) {
      ::_exit(126);
    }
  }

  TemporaryFolder folder_;
  pid_t id_ = 0;
  bool running_ = true;
};

}  // namespace dmpc::tests
