// Who looks on at a run.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "nodes/observer.h"
#include "nodes/ranks/clock_drift.h"
#include "nodes/watch/heat_map.h"

namespace dmpc::nodes {

/// Called on the host's thread whenever pixels arrive: (pixels that are done, or where light comes ray by ray that have some,
/// pixels in all) of the pass. If it throws, the run ends with that.
using Progress = std::function<void(std::uint32_t, std::uint32_t)>;

/// Whoever looks on at the nodes of other ranks, as rank 0 says.
struct WatchingElsewhere {
  /// What they are to look at, as whoever looks on there understands it; empty: nothing.
  std::string order = {};
  /// Called on the calling thread, when the run is over, with what they have seen on each other rank.
  std::function<void(std::string_view seen, const ClockDrift& clock)> add = {};
};

/// All of them outlive the run, and none changes what it does.
struct Watching {
  Progress progress = {};
  /// What each pixel takes is added to it, of the kinds that it records but `samples`. Of the size of the picture.
  HeatMap* heat = nullptr;
  Observer* observer = nullptr;  ///< sees the run happen
  /// Called on the calling thread when the nodes hold the database, which is not read again, before any node starts; by svm and
  /// replicated not on a modelled machine, whose nodes refer to it. A run that has it starts at most once.
  std::function<void()> distributed = {};
  WatchingElsewhere elsewhere = {};  ///< on ranks, where those above see rank 0's nodes alone

  /// Whether what is done is told pixel by pixel: by nodes with a Meter.
  bool is_metered() const { return heat != nullptr || observer != nullptr; }
};

}  // namespace dmpc::nodes
