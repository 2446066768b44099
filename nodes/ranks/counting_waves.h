// How ranks find that all of them stand still: everybody counts, twice (F. Mattern, "Algorithms for distributed termination
// detection", Distributed Computing 2, 1987: four counters).
//
// A rank counts for a wave while all its nodes sleep and its outbox is empty, and for the next one only when it knows what all
// have said in this. Counts only grow; so where two waves in succession have equal sums, each rank's are equal, and nobody has
// sent or received anything from its first word to its second; all first words lie before all second ones. Where as many packets
// were received as sent, none was under way in between, and nothing can come any more. No time-out is in it, and no rank is
// asked by another: each tells all others, comes to the same sums, and knows.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/expect.h"

namespace dmpc::nodes {

/// What one rank has counted, or all together.
struct Counts {
  std::uint64_t sent = 0, received = 0;  ///< packets, to and from other ranks
  std::uint64_t unfinished = 0;          ///< programs

  bool operator==(const Counts&) const = default;
};

/// One rank's view. Thread safety: none.
class CountingWaves {
 public:
  explicit CountingWaves(std::size_t rank_count) : ranks_(rank_count) {}

  /// Whether this rank has counted for the wave that is going on.
  bool has_counted(std::size_t rank) const { return ranks_[rank].waves > wave_; }
  /// What a rank says in the wave that is its next.
  void count(std::size_t rank, const Counts& counts) {
    Rank& one = ranks_.at(rank);
    core::expect(one.waves <= wave_ + 1, "nobody is two waves ahead");
    one.said[one.waves++ % one.said.size()] = counts;
  }

  /// Ends the wave if all have counted. What all stand still at, if by that they are found to.
  std::optional<Counts> end_wave() {
    for (std::size_t rank = 0; rank < ranks_.size(); ++rank) {
      if (!has_counted(rank)) {
        return std::nullopt;
      }
    }
    const Counts sum = sum_of_wave();
    const bool are_still = wave_ > 0 && sum == last_ && sum.sent == sum.received;
    ++wave_;
    last_ = sum;
    return are_still ? std::optional(sum) : std::nullopt;
  }
  /// Waves that have ended.
  std::uint64_t waves() const { return wave_; }

 private:
  struct Rank {
    std::uint64_t waves = 0;  ///< in which it has counted
    std::array<Counts, 2> said;
  };

  Counts sum_of_wave() const {
    Counts sum;
    for (const Rank& rank : ranks_) {
      const Counts& said = rank.said[wave_ % rank.said.size()];
      sum.sent += said.sent;
      sum.received += said.received;
      sum.unfinished += said.unfinished;
    }
    return sum;
  }

  std::vector<Rank> ranks_;
  std::uint64_t wave_ = 0;
  Counts last_;
};

}  // namespace dmpc::nodes
