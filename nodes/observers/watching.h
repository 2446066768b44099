// The observers of a run.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "nodes/observer.h"
#include "nodes/observers/heat_map.h"
#include "nodes/ranks/clock_drift.h"

namespace dmpc::nodes {

/// Called on the host's thread whenever results arrive, with the number of items of the pass that are done (or, if results come
/// in parts, that have some) and their total. If it throws, the run ends with that.
using Progress = std::function<void(std::uint32_t, std::uint32_t)>;

/// Takes what was observed on another rank.
using AddSeen = std::function<void(std::string_view seen, const ClockDrift& clock)>;

/// Observers of the nodes of other ranks, as ordered by rank 0.
struct WatchingElsewhere {
  /// What they are to observe, in their own format; empty: nothing.
  std::string order = {};
  /// Called on the calling thread, after the run, with what was observed on each other rank.
  AddSeen add = {};

  /// Empty if nothing is observed there.
  AddSeen adds() const { return order.empty() ? AddSeen() : add; }
};

/// All of them outlive the run, and none affects it.
struct Watching {
  Progress progress = {};
  /// The costs of each item are added to it, for the kinds that nodes count. It has as many items as the program's work.
  HeatMap* heat = nullptr;
  Observer* observer = nullptr;  ///< sees the run happen
  /// Called on the calling thread when the nodes hold all data, which are not read again, before any node starts; not if nodes
  /// refer to them (ComputerRequest::immutable()). A run that has it starts at most once.
  std::function<void()> distributed = {};
  WatchingElsewhere elsewhere = {};  ///< on ranks, where those above observe only rank 0's nodes

  /// Whether work is reported by item: by nodes with a Meter.
  bool is_metered() const { return heat != nullptr || observer != nullptr; }
};

}  // namespace dmpc::nodes
