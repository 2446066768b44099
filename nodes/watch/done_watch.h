// When each item of a program's work was last worked on, onto a heat map: an instrument beside the computer, whose memory is no
// node's.
//
// A Meter cannot know it: programs have no clock. What a call has worked on is told before its span, which alone knows when
// the call ends; so the items of a call wait for it.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "nodes/observer.h"
#include "nodes/watch/heat_map.h"

namespace dmpc::nodes {

/// Raises each item's number of the map's kind done() to the end, in nanoseconds since the start of the run, of the last call
/// that has worked on it, at whichever node; 0 of an item on which nobody has worked. Thread safety: as an Observer; the map is
/// read when the run is over.
class DoneWatch final : public Observer {
 public:
  /// `peer_count` = nodes + host. The map outlives this.
  DoneWatch(std::uint32_t peer_count, HeatMap& map);
  ~DoneWatch() override;

  void ended(const Span& span, const Program& program) override;
  void sent(const Passing&) override {}
  void received(const Passing&) override {}
  void worked(const Worked& worked) override;

 private:
  struct Call;

  HeatMap* map_;
  std::vector<std::unique_ptr<Call>> calls_;  ///< under way, by node
};

}  // namespace dmpc::nodes
