// Instruments beside a run of a program with packets.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "apps/computer/instruments.h"
#include "apps/computer/packet_pairs.h"
#include "apps/computer/record.h"

namespace dmpc::apps {

/// For one run. Thread safety: as an Observer.
class ProgramWatch {
 public:
  ProgramWatch(const ProgramOptions& options, const ProgramPlan& plan);

  /// For the run; nullptr if nobody looks on.
  nodes::Observer* observer() { return instruments_.observer(); }
  /// What was seen of nodes that are here, for add() on rank 0.
  std::string seen() const;
  /// Takes over what was seen on another rank.
  void add(std::string_view seen, const nodes::ClockDrift& clock);
  /// Puts what was seen into the record. Call it once, when the run is over.
  void take(ProgramRecord& record);

 private:
  Instruments instruments_;
  std::optional<PairWatch> pairs_;
};

}  // namespace dmpc::apps
