// Who looks on at a run of any program, as far as its options ask for it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/computer/options.h"
#include "nodes/ranks/clock_drift.h"
#include "nodes/watch/activity_profile.h"
#include "nodes/watch/observer_group.h"
#include "nodes/watch/trace.h"

namespace dmpc::apps {

/// For one run. Thread safety: as an Observer.
class Instruments {
 public:
  /// `work_of`: what its nodes are busy with.
  Instruments(const ProgramOptions& options, std::uint32_t node_count, const nodes::WorkOf& work_of);
  Instruments(const Instruments&) = delete;
  Instruments& operator=(const Instruments&) = delete;

  /// `another`, which outlives this, looks on, too. To be called before observer().
  void join(nodes::Observer& another) { members_.push_back(&another); }
  /// For the run; nullptr if nobody looks on.
  nodes::Observer* observer();

  /// What was seen of nodes that are here, for add() on rank 0.
  std::string seen() const;
  /// Takes over what was seen on another rank.
  void add(std::string_view seen, const nodes::ClockDrift& clock);

  /// What was seen, where a trace or a report is asked for. Call each once, when the run is over.
  std::optional<nodes::Trace> trace();
  std::optional<nodes::ActivitySteps> steps();

 private:
  std::optional<nodes::TraceRecorder> recorder_;
  std::optional<nodes::ActivityProfile> profile_;
  std::vector<nodes::Observer*> members_;
  std::optional<nodes::ObserverGroup> group_;
};

}  // namespace dmpc::apps
