// What rank 0 gathers from the others after a run: their nodes' reports, then their own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "nodes/ranks/exchange.h"
#include "nodes/ranks/frame.h"
#include "nodes/ranks/rank_links.h"
#include "nodes/ranks/rank_report.h"

namespace dmpc::nodes {

/// Items: report, reported, rank_traffic, rank_report, rank_reported. A rank may send its own report while rank 0 still gathers
/// those of others' nodes: hence messages of different kinds. Thread safety: belongs to one thread at a time.
class GatheringTalk {
 public:
  /// `links` outlive this.
  GatheringTalk(RankLinks& links, std::size_t processor_count)
      : links_(&links), reports_(processor_count), rank_reports_(links.rank_count()) {}

  /// Takes an item of this talk; false if it is of another.
  bool receive(std::uint32_t rank, const ItemHeader& header, std::span<const std::byte> bytes) {
    switch (header.item) {
      case Item::report:
        append(reports_.at(header.target), bytes);
        return true;
      case Item::reported:
        ++ranks_reported_;
        return true;
      case Item::rank_traffic:
        rank_reports_[rank].traffic = value_of<RankTraffic>(bytes);
        return true;
      case Item::rank_report:
        append(rank_reports_[rank].reported, bytes);
        return true;
      case Item::rank_reported:
        ++reports_ended_;
        return true;
      default:
        return false;
    }
  }

  /// `reported`: by the nodes here, by index. On rank 0 returns it with the reports of nodes elsewhere.
  std::vector<std::string> gather(std::vector<std::string> reported, const Wait& wait) {
    if (links_->rank() == 0) {
      wait([this] { return ranks_reported_ + 1 == links_->rank_count(); });
      for (std::size_t index = 0; index < reported.size(); ++index) {
        reported[index] += reports_[index];
      }
      return reported;
    }
    for (std::uint32_t index = 0; index < reported.size(); ++index) {
      if (!reported[index].empty()) {
        links_->say(0, Item::report, std::as_bytes(std::span(reported[index])), index);
      }
    }
    links_->say(0, Item::reported, {});
    wait([this] { return links_->has_said_all(); });
    return reported;
  }

  /// `own`: of this rank. On rank 0 returns those of all ranks, without clocks; elsewhere nothing.
  std::vector<RankReport> gather_ranks(RankReport own, const Wait& wait) {
    if (links_->rank() == 0) {
      wait([this] { return reports_ended_ + 1 == links_->rank_count(); });
      rank_reports_.front() = std::move(own);
      return std::move(rank_reports_);
    }
    links_->say(0, Item::rank_traffic, bytes_of(own.traffic));
    links_->say(0, Item::rank_report, std::as_bytes(std::span(own.reported)));
    links_->say(0, Item::rank_reported, {});
    wait([this] { return links_->has_said_all(); });
    return {};
  }

 private:
  static void append(std::string& text, std::span<const std::byte> bytes) {
    text.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }

  RankLinks* links_;
  std::vector<std::string> reports_;      ///< by other ranks' nodes, by node
  std::vector<RankReport> rank_reports_;  ///< by other ranks
  std::uint32_t ranks_reported_ = 0, reports_ended_ = 0;
};

}  // namespace dmpc::nodes
