// The nodes' activities over the observed time, in a bounded number of steps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "nodes/observers/activity_profile.h"
#include "nodes/observers/live_counts.h"

namespace dmpc::apps {

/// Cumulative counts at a moment.
struct LiveMoment {
  std::uint64_t ms = 0;                ///< wall clock
  std::uint64_t ns = 0;                ///< on the nodes' clock
  std::vector<nodes::WorkTimes> busy;  ///< per node, without the host

  /// The current moment, from the nodes' counters.
  LiveMoment(std::uint64_t now_ms, const std::vector<nodes::LiveNode>& nodes);
};

/// Stores up to `steps_max` + 1 moments, 48 bytes per node each; beyond that every second one is dropped, so that steps become
/// twice as long. Thread safety: none.
class LiveSteps {
 public:
  /// `steps_max` is even.
  explicit LiveSteps(std::size_t steps_max = 240) : steps_max_(steps_max) {}

  /// Moments are added at regular intervals. Returns the first step that is new or changed: count() if none is.
  std::size_t add(LiveMoment moment);
  std::size_t count() const { return moments_.empty() ? 0 : moments_.size() - 1; }
  /// How many times the length of steps has doubled.
  std::uint32_t doublings() const { return doublings_; }
  /// Relative to the first moment.
  std::uint64_t end_ms(std::size_t step) const { return moments_[step + 1].ms - moments_[0].ms; }
  /// The first moment; nullptr if there is none.
  const LiveMoment* first() const { return moments_.empty() ? nullptr : &moments_.front(); }
  /// A byte per node: its busy share of the time on its clock, from 0 to `levels_max`, times the number of kinds of work, plus
  /// the number of the kind that took most.
  std::string cells(std::size_t step) const;
  void clear();

  static constexpr std::size_t levels_max = 30;
  static_assert(levels_max * nodes::work_count + nodes::work_count <= 256, "in a byte");

 private:
  std::size_t steps_max_;
  std::vector<LiveMoment> moments_;
  std::uint32_t doublings_ = 0;
  std::uint64_t added_ = 0;
};

/// Shares of the nodes' time between two moments by kind of work, 0 to 1.
std::vector<double> shares_between(const LiveMoment& before, const LiveMoment& after);

}  // namespace dmpc::apps
