// What rank 0 gathers from the others after a run: what their nodes have to say, then what they have to say themselves.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "nodes/ranks/exchange.h"
#include "nodes/ranks/frame.h"
#include "nodes/ranks/rank_links.h"
#include "nodes/ranks/rank_report.h"

namespace dmpc::nodes {

/// Items: report, reported, rank_traffic, rank_report, rank_reported. A rank may say of itself while rank 0 still gathers from
/// others what their nodes say: hence words of other kinds. Thread safety: belongs to one thread at a time.
class GatheringTalk {
 public:
  /// `links` outlive this.
  GatheringTalk(RankLinks& links, std::size_t processor_count)
      : links_(&links), reports_(processor_count), rank_reports_(links.rank_count()) {}

  /// Takes an item of this talk; false if it is of another.
  bool receive(std::uint32_t rank, const ItemHeader& header, std::span<const std::byte> bytes);

  /// `told` by the nodes here, by index. On rank 0 with what nodes elsewhere told.
  std::vector<std::string> gather(std::vector<std::string> told, const Wait& wait);
  /// `own`: of this rank. On rank 0 those of all ranks, but for clocks; else nothing.
  std::vector<RankReport> gather_ranks(RankReport own, const Wait& wait);

 private:
  RankLinks* links_;
  std::vector<std::string> reports_;      ///< of other ranks' nodes, by node
  std::vector<RankReport> rank_reports_;  ///< of other ranks themselves
  std::uint32_t ranks_reported_ = 0, ranks_told_ = 0;
};

}  // namespace dmpc::nodes
