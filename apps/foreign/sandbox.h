// What takes nearly everything from a process that is about to read foreign matter.
#pragma once

#include <cstdint>

#include "apps/reader/confinement.h"

namespace dmpc::apps {

/// Before anything else: the process ends with the one that started it.
void tie_to_parent();
/// It is the first that the system ends when memory ends.
void be_first_to_end();

/// From now on this process can open, make or remove no file; whether that is so. Needs Landlock, which not every kernel has.
bool forbid_files();

/// From now on this process, which has one thread, can neither open nor write files, reach the network, or start threads and
/// programs, and may take `memory_bytes` beside what it has. Returns what of that the kernel does; the rest holds nevertheless.
Confinement enter_sandbox(std::uint64_t memory_bytes);

}  // namespace dmpc::apps
