// The ranks' protocol for clocks: rank 0 asks the others, before the start, which it announces, and again after the run.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "nodes/ranks/clock_drift.h"
#include "nodes/ranks/exchange.h"
#include "nodes/ranks/frame.h"
#include "nodes/ranks/rank_links.h"
#include "nodes/threads/clock.h"

namespace dmpc::nodes {

/// Items: clock_asked, clock_reported, clocks_read, start. Thread safety: belongs to one thread at a time.
class ClockTalk {
 public:
  /// `links` outlive this. `compares`, used on rank 0: whether clocks are to be compared; the others are informed.
  ClockTalk(RankLinks& links, bool compares) : links_(&links), compares_(compares) {}

  /// Takes an item of this talk; false if it is of another.
  bool receive(std::uint32_t rank, const ItemHeader& header, std::span<const std::byte> bytes) {
    switch (header.item) {
      case Item::clock_asked:
        compares_ = true;  // before the start, hence after the run, too
        links_->say(rank, Item::clock_reported, bytes_of(nanoseconds(CLOCK_MONOTONIC)));
        return true;
      case Item::clock_reported:
        heard_ = {.reported_ns = value_of<std::uint64_t>(bytes), .heard_ns = nanoseconds(CLOCK_MONOTONIC)};
        return true;
      case Item::clocks_read:
        are_clocks_read_ = true;
        return true;
      case Item::start:
        start_ns_ = value_of<std::uint64_t>(bytes);
        may_start_ = true;
        return true;
      default:
        return false;
    }
  }

  /// Nobody starts until all ranks have made their nodes: otherwise packets would arrive without a mailbox. Rank 0 knows when.
  /// `wait` may end early once a rank has failed, which may never answer.
  void start(const Wait& wait) {
    if (links_->rank() != 0) {
      wait([this] { return may_start_; });
      start_ns_ = std::min(start_ns_, nanoseconds(CLOCK_MONOTONIC));  // with clock errors it may lie in the future
      return;
    }
    if (compares_) {
      before_ = read_clocks(wait);
    }
    start_ns_ = nanoseconds(CLOCK_MONOTONIC);
    for (std::uint32_t rank = 1; rank < links_->rank_count(); ++rank) {
      const auto offset_ns = static_cast<std::uint64_t>(compares_ ? before_[rank].offset_ns() : 0);
      links_->say(rank, Item::start, bytes_of(start_ns_ + offset_ns));
    }
  }

  /// When the run starts, by this rank's clock.
  std::uint64_t start_ns() const { return start_ns_; }

  /// Whether there is an exchange after the run.
  bool compares() const { return compares_; }
  /// On rank 0: asks again then. The others answer until it asks no more.
  void ask_again(const Wait& wait) {
    if (links_->rank() == 0) {
      after_ = read_clocks(wait);
      links_->say_to_all(Item::clocks_read, {});
    }
  }

  bool is_over() const { return links_->rank() == 0 ? links_->has_said_all() : are_clocks_read_; }
  /// The drift of another rank, on rank 0; that of equal clocks if they were not compared.
  ClockDrift drift_of(std::uint32_t rank) const {
    return after_.empty() ? ClockDrift() : ClockDrift(before_[rank], after_[rank], start_ns_);
  }

 private:
  /// The shortest of several round trips to each other rank.
  std::vector<ClockAnswer> read_clocks(const Wait& wait) {
    std::vector<ClockAnswer> shortest(links_->rank_count());
    for (std::uint32_t rank = 1; rank < links_->rank_count(); ++rank) {
      for (int question = 0; question < clock_questions; ++question) {
        const ClockAnswer next = ask(rank, wait);
        if (question == 0 || next.round_trip_ns() < shortest[rank].round_trip_ns()) {
          shortest[rank] = next;
        }
      }
    }
    return shortest;
  }

  /// The answer is useless if the wait has ended early.
  ClockAnswer ask(std::uint32_t rank, const Wait& wait) {
    heard_.reset();
    const std::uint64_t asked_ns = nanoseconds(CLOCK_MONOTONIC);
    links_->say(rank, Item::clock_asked, {});
    wait([this] { return heard_.has_value(); });
    ClockAnswer answer = heard_.value_or(ClockAnswer{});
    answer.asked_ns = asked_ns;
    return answer;
  }

  RankLinks* links_;
  bool compares_;
  std::uint64_t start_ns_ = 0;
  std::vector<ClockAnswer> before_, after_;  ///< before and after the run, by rank: what rank 0 knows of others' clocks
  std::optional<ClockAnswer> heard_;         ///< to the last question
  bool may_start_ = false, are_clocks_read_ = false;
};

}  // namespace dmpc::nodes
