// The report of each rank after a run.
#pragma once

#include <cstdint>
#include <string>
#include <type_traits>

#include "nodes/ranks/clock_drift.h"

namespace dmpc::nodes {

/// The traffic between a rank and others.
struct RankTraffic {
  std::uint64_t packets_sent = 0, packets_received = 0;  ///< nodes' packets
  std::uint64_t frames_sent = 0, bytes_sent = 0;         ///< since the end of the run before
  std::uint64_t waves = 0;                               ///< counted until termination
};
static_assert(std::is_trivially_copyable_v<RankTraffic>, "it travels as bytes to rank 0");

struct RankReport {
  RankTraffic traffic;
  ClockDrift clock;      ///< if the run is observed
  std::string reported;  ///< the caller's report there
};

}  // namespace dmpc::nodes
