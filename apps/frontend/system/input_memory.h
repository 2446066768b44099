// Limit of this computer's memory for foreign files.
#pragma once

#include <cstdint>

#include "apps/frontend/system/available_memory.h"

namespace dmpc::apps {

/// Returns three quarters of the memory available to this process or its container at the first call.
inline std::uint64_t reader_memory_bytes_max() {
  static const std::uint64_t bytes = available_memory().bytes / 4 * 3;
  return bytes;
}

}  // namespace dmpc::apps
