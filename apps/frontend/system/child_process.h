// Runs a program as a child process, isolated from this process's standard streams.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/frontend/system/memory_file.h"

namespace dmpc::apps {

struct ChildSettings {
  std::string program;  ///< searched along PATH unless it has a slash
  std::vector<std::string> arguments;
  std::filesystem::path folder = ".";  ///< its working directory
  bool gets_ctrl_c = true;             ///< whether the terminal's Ctrl-C reaches it, too
  int input = -1, output = -1;         ///< open files for its stdin and stdout; below 0: /dev/null
  /// Its descendants end with it: processes that it leaves behind are killed when it ends, and it is killed when this process
  /// ends, without being asked to end. Excludes gets_ctrl_c.
  bool leaves_nothing = false;
};

/// The destructor kills the process and waits for it, unless it has ended. It receives SIGTERM if the thread that made it ends
/// first. Signals that are blocked or ignored in this process are reset in the child.
class ChildProcess {
 public:
  /// Throws core::InputError "PROGRAM cannot be started: ...", or ComputerCapacityError if resources of this computer are
  /// exhausted.
  explicit ChildProcess(const ChildSettings& settings);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  pid_t id() const { return id_; }
  /// Returns its exit status once it has ended; below 0: the signal that ended it.
  std::optional<int> status();
  /// Waits for the end, and returns status().
  int wait();
  /// Returns its output to stderr so far.
  std::string errors() const { return errors_.bytes(); }

 private:
  void wait_for_end() const;
  bool has_ended(int options) const;
  void end_group() const;
  int take_end();

  MemoryFile errors_;
  bool leaves_nothing_;
  pid_t id_ = -1;
  std::optional<int> status_;
};

}  // namespace dmpc::apps
