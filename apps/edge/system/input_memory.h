// How much of this computer's memory foreign matter may take.
#pragma once

#include <unistd.h>

#include <cstdint>

namespace dmpc::apps {

/// Three quarters of what there is.
inline std::uint64_t reader_memory_bytes_max() {
  const auto pages = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES));
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) / 4 * 3;
}

}  // namespace dmpc::apps
