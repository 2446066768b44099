// How much memory there is for this process: less than the computer has, if it runs in a container.
#pragma once

#include <cstdint>
#include <string>

#include "apps/frontend/system/resource_exhaustion.h"

namespace dmpc::apps {

struct AvailableMemory {
  std::uint64_t bytes = 0;
  std::string source;     ///< who says so, as a part of a sentence: "this computer's memory"
  bool is_limit = false;  ///< a limit of a container or a shell; the computer may have more
};

/// The least of this computer's memory, the limits of this process's address space and data (ulimit -v, -d), and those of its
/// control groups (memory.max, memory.limit_in_bytes) and their parents. Swap counts, as far as it is allowed. `root` stands
/// before the names of the files that are read. What cannot be read is no limit.
AvailableMemory available_memory(const std::string& root = "");

/// Throws ComputerCapacityError if `bytes` for `what` ("64 nodes") are more than there is room for.
void check_available_memory(std::uint64_t bytes, const std::string& what, const AvailableMemory& room = available_memory());

/// From now on an allocation that goes beyond the room fails, and can be spoken of, where else the system would kill some
/// process.
void bound_memory(const AvailableMemory& room = available_memory());

}  // namespace dmpc::apps
