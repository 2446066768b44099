// Figures of each rank after a run.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/base/expect.h"
#include "nodes/ranks/rank_links.h"
#include "nodes/ranks/rank_memory.h"
#include "nodes/ranks/rank_report.h"

namespace dmpc::nodes {

/// The figures of one rank.
struct RankFigures {
  std::string name;  ///< "rank 2 on host b"
  RankMemory memory;
  RankTraffic traffic;
  ClockDrift clock;  ///< if the run is observed
};

/// The figures of all ranks, by number: the memory of their nodes and the host, and each rank's report.
inline std::vector<RankFigures> rank_figures(std::span<const PeerMemory> peers, const RankLinks& links,
                                             const std::vector<RankReport>& reports) {
  std::vector<RankFigures> figures;
  for (std::uint32_t rank = 0; rank < reports.size(); ++rank) {
    figures.push_back({links.name_of(rank), rank_memory(peers, &links, rank), reports[rank].traffic, reports[rank].clock});
  }
  return figures;
}

/// After a regular end.
inline void expect_nothing_lost(const std::vector<RankFigures>& ranks) {
  std::uint64_t sent = 0, received = 0;
  for (const RankFigures& rank : ranks) {
    sent += rank.traffic.packets_sent;
    received += rank.traffic.packets_received;
  }
  core::expect(sent == received, "every packet that was sent to another rank was received there");
}

}  // namespace dmpc::nodes
