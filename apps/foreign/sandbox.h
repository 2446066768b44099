// What takes nearly everything from a process that is about to read foreign matter.
#pragma once

#include <cstdint>

namespace dmpc::apps {

/// Before anything else: the process ends with the one that started it, and is the first that the system ends when memory ends.
void tie_to_parent();

/// From now on this process can open, make or remove no file; whether that is so. Needs Landlock, which not every kernel has.
bool forbid_files();

/// From now on this process, which has one thread, can neither open nor write files, reach the network, or start threads and
/// programs, and may take `memory_bytes` beside what it has. Returns whether the kernel refuses it all calls but the few that it
/// needs, and all limits are set; where it cannot, what can be taken from it is nevertheless.
bool enter_sandbox(std::uint64_t memory_bytes);

}  // namespace dmpc::apps
