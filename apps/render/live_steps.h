// What nodes were busy with over the time that somebody has looked on, in a bounded number of steps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "nodes/observers/activity_profile.h"
#include "nodes/observers/live_counts.h"

namespace dmpc::apps {

/// What had been counted by when.
struct LiveMoment {
  std::uint64_t ms = 0;                ///< wall clock
  std::uint64_t ns = 0;                ///< on the nodes' clock
  std::vector<nodes::WorkTimes> busy;  ///< per node, without the host

  /// Now, of what was read of the nodes.
  LiveMoment(std::uint64_t now_ms, const std::vector<nodes::LiveNode>& nodes);
};

/// Keeps up to `steps_max` + 1 moments, 48 bytes a node each; when it has more, every second is forgotten, so that steps are
/// twice as long from then on. Thread safety: none.
class LiveSteps {
 public:
  /// `steps_max` is even.
  explicit LiveSteps(std::size_t steps_max = 240) : steps_max_(steps_max) {}

  /// Moments come at regular intervals. Returns the first step that is new, or has become another: count() if none has.
  std::size_t add(LiveMoment moment);
  std::size_t count() const { return moments_.empty() ? 0 : moments_.size() - 1; }
  /// How many times steps have become twice as long.
  std::uint32_t doublings() const { return doublings_; }
  /// Since the first moment.
  std::uint64_t end_ms(std::size_t step) const { return moments_[step + 1].ms - moments_[0].ms; }
  /// With which they begin; nullptr if there is none.
  const LiveMoment* first() const { return moments_.empty() ? nullptr : &moments_.front(); }
  /// A byte a node: how busy it was, from 0 to `levels_max` of the time that passed on its clock, times the number of kinds of
  /// work, plus the number of the kind that took most.
  std::string cells(std::size_t step) const;
  void clear();

  static constexpr std::size_t levels_max = 40;
  static_assert(levels_max * nodes::work_count + nodes::work_count <= 256, "in a byte");

 private:
  std::size_t steps_max_;
  std::vector<LiveMoment> moments_;
  std::uint32_t doublings_ = 0;
  std::uint64_t added_ = 0;
};

/// Parts of the nodes' time between two moments that went into each kind of work, 0 to 1.
std::vector<double> shares_between(const LiveMoment& before, const LiveMoment& after);

}  // namespace dmpc::apps
