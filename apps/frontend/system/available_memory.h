// Memory available to this process, which may be less than the computer's in a container.
#pragma once

#include <cstdint>
#include <string>

namespace dmpc::apps {

struct AvailableMemory {
  std::uint64_t bytes = 0;
  std::string source;     ///< origin of the limit, as a part of a sentence: "this computer's memory"
  bool is_limit = false;  ///< a limit of a container or a shell; the computer may have more
};

/// Returns the minimum of this computer's memory, the limits of this process's address space and data (ulimit -v, -d), and those
/// of its control groups (memory.max, memory.limit_in_bytes) and their parents. Swap counts as far as it is allowed. `root` is a
/// prefix of the names of the files that are read. A file that cannot be read sets no limit.
AvailableMemory available_memory(const std::string& root = "");

/// Throws ComputerCapacityError if `bytes` for `what` ("64 nodes") exceed the available memory.
void check_available_memory(std::uint64_t bytes, const std::string& what, const AvailableMemory& room = available_memory());

/// Limits this process to the available memory, so that further allocations fail and can be reported, instead of the system
/// killing a process.
void bound_memory(const AvailableMemory& room = available_memory());

/// Returns the limit for what foreign files become: three quarters of the memory available to this process or its container at
/// the first call.
inline std::uint64_t reader_memory_bytes_max() {
  static const std::uint64_t bytes = available_memory().bytes / 4 * 3;
  return bytes;
}

}  // namespace dmpc::apps
