// The real computer's clocks.
#pragma once

#include <cstdint>
#include <ctime>

namespace dmpc::nodes {

/// What the clock shows, in nanoseconds: CLOCK_MONOTONIC, or CLOCK_THREAD_CPUTIME_ID for the processor's time of the calling
/// thread.
inline std::uint64_t nanoseconds(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<std::uint64_t>(now.tv_sec) * 1'000'000'000U + static_cast<std::uint64_t>(now.tv_nsec);
}

}  // namespace dmpc::nodes
