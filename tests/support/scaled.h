// How much of a test to do: everything in a release build, a part under sanitizers and without optimisation.
#pragma once

#include <cstddef>
#include <cstdlib>

namespace dmpc::tests {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__OPTIMIZE__)
inline constexpr std::size_t slowness = 16;
#else
inline constexpr std::size_t slowness = 1;
#endif

/// `count` where the build is fast, a sixteenth of it (at least 1) where it is slow.
constexpr std::size_t scaled(std::size_t count) { return count < slowness ? 1 : count / slowness; }

/// The edge of a picture of which a slow build renders a sixteenth.
constexpr int scaled_edge(int pixels) { return slowness == 1 ? pixels : (pixels + 3) / 4; }

/// How many rays a stress test shoots: DMPC_RAYS if it is set, else scaled(count).
inline std::size_t ray_count(std::size_t count) {
  const char* wanted = std::getenv("DMPC_RAYS");
  return wanted != nullptr ? std::strtoull(wanted, nullptr, 10) : scaled(count);
}

}  // namespace dmpc::tests
