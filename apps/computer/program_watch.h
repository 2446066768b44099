// Instruments beside a run of a program with packets.
#pragma once

#include <cstdint>
#include <optional>

#include "apps/computer/instruments.h"
#include "apps/computer/packet_pairs.h"
#include "apps/computer/record.h"

namespace dmpc::apps {

/// For one run. Thread safety: as an Observer.
class ProgramWatch {
 public:
  ProgramWatch(const ProgramOptions& options, std::uint32_t node_count);

  /// For the run; nullptr if nobody looks on.
  nodes::Observer* observer() { return instruments_.observer(); }
  /// Puts what was seen into the record. Call it once, when the run is over.
  void take(ProgramRecord& record);

 private:
  Instruments instruments_;
  std::optional<PairWatch> pairs_;
};

}  // namespace dmpc::apps
