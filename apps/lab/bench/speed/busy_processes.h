// Others that keep the processors busy, while something is timed beside them.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <deque>
#include <vector>

#include "apps/edge/system/child_process.h"

namespace dmpc::apps {

/// Shells that count for nothing in a loop, each a process of its own with hardly any memory, which takes what processor time it
/// gets. They are ended with this, after a signal, too, and with the thread that made it. Not thread-safe.
class BusyProcesses {
 public:
  /// Throws core::InputError if there is no shell (sh), as ComputerRoomError if this computer has no room for so many.
  explicit BusyProcesses(std::size_t count);

  std::vector<pid_t> ids() const;

 private:
  std::deque<ChildProcess> processes_;
};

}  // namespace dmpc::apps
