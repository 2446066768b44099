// Who looks on at a program's run, on every rank.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "apps/computer/options.h"
#include "nodes/ranks/clock_drift.h"
#include "nodes/watch/trace.h"

namespace dmpc::apps {

/// All that the options ask for.
class ProgramOnlookers {
 public:
  ProgramOnlookers(const ProgramOptions& options, std::uint32_t node_count) {
    if (options.trace) {
      recorder_.emplace(node_count + 1, nodes::TraceChoice{});
    }
  }

  /// nullptr if nobody looks on.
  nodes::Observer* observer() { return recorder_ ? &*recorder_ : nullptr; }
  /// What was seen here, for add() on rank 0.
  std::string seen() const { return recorder_ ? recorder_->bytes() : std::string(); }
  void add(std::string_view seen, const nodes::ClockDrift& clock) {
    if (recorder_) {
      recorder_->add(seen, clock);
    }
  }
  /// Call it once, after the run.
  std::optional<nodes::Trace> take_trace() { return recorder_ ? std::optional(recorder_->take()) : std::nullopt; }

 private:
  std::optional<nodes::TraceRecorder> recorder_;
};

}  // namespace dmpc::apps
