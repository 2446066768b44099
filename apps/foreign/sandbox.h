// What takes nearly everything from a process that is about to read foreign matter.
#pragma once

#include <cstdint>

#include "apps/reader/confinement.h"

namespace dmpc::apps {

/// Before anything else: the process ends with the one that started it; whether that is so.
bool tie_to_parent();
/// It is the first that the system ends when memory ends.
void be_first_to_end();

/// What Landlock takes from this process from now on, of which not every kernel has all: opening, making and removing files, and
/// what else it may reach, Confinement::is_reach_forbidden.
struct Forbidden {
  bool are_files = false, is_reach = false;
};
Forbidden forbid_by_landlock();

/// From now on this process, which has one thread, can neither open nor write files, reach the network, or start threads and
/// programs, and may take `memory_bytes` beside what it has. Returns what of that the kernel does; the rest holds nevertheless.
Confinement enter_sandbox(std::uint64_t memory_bytes);

}  // namespace dmpc::apps
