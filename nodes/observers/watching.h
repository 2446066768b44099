// Who looks on at a run.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "nodes/observer.h"
#include "nodes/observers/heat_map.h"
#include "nodes/ranks/clock_drift.h"

namespace dmpc::nodes {

/// Called on the host's thread whenever results arrive: (items that are done, or where results come in parts that have some,
/// items in all) of the pass. If it throws, the run ends with that.
using Progress = std::function<void(std::uint32_t, std::uint32_t)>;

/// Takes what was seen on another rank.
using AddSeen = std::function<void(std::string_view seen, const ClockDrift& clock)>;

/// Whoever looks on at the nodes of other ranks, as rank 0 says.
struct WatchingElsewhere {
  /// What they are to look at, as whoever looks on there understands it; empty: nothing.
  std::string order = {};
  /// Called on the calling thread, when the run is over, with what they have seen on each other rank.
  AddSeen add = {};

  /// Nobody where nothing is to be looked at.
  AddSeen adds() const { return order.empty() ? AddSeen() : add; }
};

/// All of them outlive the run, and none changes what it does.
struct Watching {
  Progress progress = {};
  /// What each item takes is added to it, of the kinds that nodes count. It has as many items as the program's work.
  HeatMap* heat = nullptr;
  Observer* observer = nullptr;  ///< sees the run happen
  /// Called on the calling thread when the nodes hold all data, which are not read again, before any node starts; not where nodes
  /// of a modelled machine refer to them (ImmutablePieces). A run that has it starts at most once.
  std::function<void()> distributed = {};
  WatchingElsewhere elsewhere = {};  ///< on ranks, where those above see rank 0's nodes alone

  /// Whether what is done is told item by item: by nodes with a Meter.
  bool is_metered() const { return heat != nullptr || observer != nullptr; }
};

}  // namespace dmpc::nodes
