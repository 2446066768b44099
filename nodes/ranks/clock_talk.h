// What ranks say of their clocks: rank 0 asks the others, before the start, which it gives, and again after the run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "nodes/ranks/clock_drift.h"
#include "nodes/ranks/exchange.h"
#include "nodes/ranks/frame.h"
#include "nodes/ranks/rank_links.h"

namespace dmpc::nodes {

/// Items: clock_asked, clock_told, clocks_read, start. Thread safety: belongs to one thread at a time.
class ClockTalk {
 public:
  /// `links` outlive this. On rank 0 `compares` says whether clocks are to be compared; the others hear of it.
  ClockTalk(RankLinks& links, bool compares) : links_(&links), compares_(compares) {}

  /// Takes an item of this talk; false if it is of another.
  bool receive(std::uint32_t rank, const ItemHeader& header, std::span<const std::byte> bytes);

  /// Until all ranks have made their nodes nobody starts: packets would come where there is no mailbox yet. Rank 0 knows when.
  /// `wait` may end before its time once a rank has failed, which may never answer.
  void start(const Wait& wait);
  /// When the run starts, by this rank's clock.
  std::uint64_t start_ns() const { return start_ns_; }

  /// There is something to say after the run.
  bool compares() const { return compares_; }
  /// Rank 0 does so then. They answer until they hear that it asks no more.
  void ask_again(const Wait& wait);
  bool is_over() const { return links_->rank() == 0 ? links_->has_said_all() : are_clocks_read_; }
  /// The drift of another rank, on rank 0; that of equal clocks if they were not compared.
  ClockDrift drift_of(std::uint32_t rank) const;

 private:
  std::vector<ClockAnswer> read_clocks(const Wait& wait);
  ClockAnswer ask(std::uint32_t rank, const Wait& wait);

  RankLinks* links_;
  bool compares_;
  std::uint64_t start_ns_ = 0;
  std::vector<ClockAnswer> before_, after_;  ///< the run, by rank: what rank 0 knows of others' clocks
  std::optional<ClockAnswer> heard_;         ///< to the last question
  bool may_start_ = false, are_clocks_read_ = false;
};

}  // namespace dmpc::nodes
