// How much of this computer's memory foreign matter may take.
#pragma once

#include <cstdint>

#include "apps/frontend/system/available_memory.h"

namespace dmpc::apps {

/// Three quarters of what there is for this process at the first call, in a container of what that has.
inline std::uint64_t reader_memory_bytes_max() {
  static const std::uint64_t bytes = available_memory().bytes / 4 * 3;
  return bytes;
}

}  // namespace dmpc::apps
