// How much memory there is for this process: less than the computer has, if it runs in a container.
#pragma once

#include <cstdint>
#include <string>

#include "apps/edge/system/shortage.h"

namespace dmpc::apps {

struct MemoryRoom {
  std::uint64_t bytes = 0;
  std::string source;     ///< who says so, as a part of a sentence: "this computer's memory"
  bool is_limit = false;  ///< of a container or a shell, where the computer may have more
};

/// The least of this computer's memory, the limits of this process's address space and data (ulimit -v, -d), and those of its
/// control groups (memory.max, memory.limit_in_bytes) and their parents. Swap counts, as far as it is allowed. `root` stands
/// before the names of the files that are read. What cannot be read is no limit.
MemoryRoom memory_room(const std::string& root = "");

/// Throws ComputerRoomError if `bytes` for `what` ("64 nodes") are more than there is room for.
void check_memory_room(std::uint64_t bytes, const std::string& what, const MemoryRoom& room = memory_room());

/// From now on an allocation that goes beyond the room fails, and can be spoken of, where else the system would kill some
/// process.
void bound_memory(const MemoryRoom& room = memory_room());

}  // namespace dmpc::apps
