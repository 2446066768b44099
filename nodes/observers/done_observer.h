// Records on a heat map when each item of a program's work was last processed; an instrument outside of the computer, whose
// memory is no node's.
//
// A Meter cannot do this: programs have no clock. What a call has worked on is reported before its span, which alone has the end
// of the call; so the items of a call wait for it.
#pragma once

#include <cstdint>
#include <vector>

#include "nodes/atomics.h"
#include "nodes/observer.h"
#include "nodes/observers/heat_map.h"

namespace dmpc::nodes {

/// Raises each item's number of the map's kind done() to the end, in nanoseconds since the start of the run, of the last call
/// that has worked on it, on any node; 0 for an item on which no call has worked. Thread safety: as an Observer; the map is read
/// when the run is over.
class DoneObserver final : public Observer {
 public:
  /// `peer_count` = nodes + host. The map outlives this.
  DoneObserver(std::uint32_t peer_count, HeatMap& map) : map_(&map), calls_(peer_count) {}

  void ended(const Span& span, const Program& /*program*/) override {
    if (!span.is_own_call()) {
      return;  // an interrupt within a call, which works on nothing, or no call at all
    }
    std::vector<std::uint32_t>& items = calls_[index_of(span.node)].items;
    for (const std::uint32_t item : items) {
      map_->raise(map_->done(), item, span.end_ns);
    }
    items.clear();
  }
  void worked(const Worked& worked) override { calls_[index_of(worked.node)].items.push_back(worked.item); }

 private:
  /// On its own cache lines. It has no more items than one call works on.
  struct alignas(cache_line_bytes) Call {
    std::vector<std::uint32_t> items;
  };

  HeatMap* map_;
  std::vector<Call> calls_;  ///< in progress, by node
};

}  // namespace dmpc::nodes
