#include "nodes/ranks/clock_talk.h"

#include <algorithm>

#include "nodes/threads/clock.h"

namespace dmpc::nodes {

bool ClockTalk::receive(std::uint32_t rank, const ItemHeader& header, std::span<const std::byte> bytes) {
  switch (header.item) {
    case Item::clock_asked:
      compares_ = true;  // before the start, hence after the run, too
      links_->say(rank, Item::clock_told, bytes_of(nanoseconds(CLOCK_MONOTONIC)));
      return true;
    case Item::clock_told:
      heard_ = {.told_ns = value_of<std::uint64_t>(bytes), .heard_ns = nanoseconds(CLOCK_MONOTONIC)};
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

void ClockTalk::start(const Wait& wait) {
  if (links_->rank() != 0) {
    wait([this] { return may_start_; });
    start_ns_ = std::min(start_ns_, nanoseconds(CLOCK_MONOTONIC));  // as far as the clocks go wrong, it may be to come
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

void ClockTalk::ask_again(const Wait& wait) {
  if (links_->rank() == 0) {
    after_ = read_clocks(wait);
    links_->say_to_all(Item::clocks_read, {});
  }
}

ClockDrift ClockTalk::drift_of(std::uint32_t rank) const {
  return after_.empty() ? ClockDrift() : ClockDrift(before_[rank], after_[rank], start_ns_);
}

/// The shortest of several round trips to each other rank.
std::vector<ClockAnswer> ClockTalk::read_clocks(const Wait& wait) {
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

/// Nothing of use if the wait has ended before its time.
ClockAnswer ClockTalk::ask(std::uint32_t rank, const Wait& wait) {
  heard_.reset();
  const std::uint64_t asked_ns = nanoseconds(CLOCK_MONOTONIC);
  links_->say(rank, Item::clock_asked, {});
  wait([this] { return heard_.has_value(); });
  ClockAnswer answer = heard_.value_or(ClockAnswer{});
  answer.asked_ns = asked_ns;
  return answer;
}

}  // namespace dmpc::nodes
