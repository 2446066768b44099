// A program as a process of its own, with nothing to read but what whoever started it gives it, and nobody else to write to.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/frontend/system/memory_file.h"

namespace dmpc::apps {

/// How a program is started.
struct ChildSettings {
  std::string program;  ///< looked for along PATH unless it has a slash
  std::vector<std::string> arguments;
  std::filesystem::path folder = ".";  ///< where it runs
  bool gets_ctrl_c = true;             ///< the terminal's Ctrl-C reaches it, too
  int input = -1, output = -1;         ///< opened files that are its stdin and stdout; below 0: /dev/null
  /// Nothing of it outlives us: what it has started and left behind is killed when it ends, and it is killed, not asked to end,
  /// when we end. Not with gets_ctrl_c.
  bool leaves_nothing = false;
};

/// Killed and waited for in the end, unless it has ended before; ended (SIGTERM) where the thread that made it ends before, by
/// whatever: nobody would take what it does. Signals that are blocked or ignored here are neither there.
class ChildProcess {
 public:
  /// Throws core::InputError "PROGRAM cannot be started: ...", as ComputerCapacityError if this computer has no room for it.
  explicit ChildProcess(const ChildSettings& settings);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  pid_t id() const { return id_; }
  /// Its exit status, once it has ended; below 0: the signal that ended it.
  std::optional<int> status();
  /// Waits for the end, and says how it ended.
  int wait();
  /// What it has written to stderr so far.
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
