#include "svm/replacement.h"

#include <algorithm>

#include "core/base/expect.h"
#include "core/base/sampling.h"

namespace dmpc::svm {
namespace {

using nodes::Category;
using nodes::LocalMemory;

/// More would make a search dearer, fewer would make searches more frequent.
constexpr std::uint32_t candidate_count_max = 64;

std::uint32_t after(std::uint32_t frame, Stamps stamps) { return frame + 1 < stamps.size() ? frame + 1 : 0; }

}  // namespace

std::string_view name_of(Replacement replacement) {
  switch (replacement) {
    case Replacement::lru:
      return "lru";
    case Replacement::clock:
      return "clock";
    case Replacement::fifo:
      return "fifo";
    case Replacement::random:
      return "random";
  }
  core::expect(false, "a replacement policy has a name");
  return "";
}

std::size_t LeastRecentlyUsed::candidate_capacity(std::uint32_t frame_count) {
  return std::min(frame_count, candidate_count_max);
}

void LeastRecentlyUsed::add_needs(nodes::MemoryPlan& plan, std::uint32_t frame_count) {
  plan[Category::page_table] += LocalMemory::bytes_for<Candidate>(candidate_capacity(frame_count));
}

LeastRecentlyUsed::LeastRecentlyUsed(LocalMemory& memory, std::uint32_t frame_count)
    : candidates_(memory.allocate<Candidate>(Category::page_table, candidate_capacity(frame_count))) {}

std::uint32_t LeastRecentlyUsed::victim(Stamps stamps) {
  while (true) {
    while (next_candidate_ < candidate_count_) {
      const Candidate& candidate = candidates_[next_candidate_++];
      if (stamps[candidate.frame] == candidate.stamp) {
        return candidate.frame;
      }
    }
    seek_candidates(stamps);
  }
}

/// One pass with a heap whose top is the youngest of the oldest.
void LeastRecentlyUsed::seek_candidates(Stamps stamps) {
  const auto older = [](const Candidate& a, const Candidate& b) { return a.stamp < b.stamp; };
  const auto begin = candidates_.begin();
  auto end = begin;
  for (std::uint32_t frame = 0; frame < stamps.size(); ++frame) {
    if (end != candidates_.end()) {
      *end++ = {stamps[frame], frame};
      std::push_heap(begin, end, older);
    } else if (stamps[frame] < begin->stamp) {
      std::pop_heap(begin, end, older);
      *(end - 1) = {stamps[frame], frame};
      std::push_heap(begin, end, older);
    }
  }
  std::sort_heap(begin, end, older);
  candidate_count_ = static_cast<std::size_t>(end - begin);
  next_candidate_ = 0;
}

std::uint32_t Clock::victim(Stamps stamps) {
  while (stamps[hand_] != 0) {
    stamps[hand_] = 0;
    hand_ = after(hand_, stamps);
  }
  const std::uint32_t frame = hand_;
  hand_ = after(hand_, stamps);
  return frame;
}

std::uint32_t FirstInFirstOut::victim(Stamps stamps) {
  const std::uint32_t frame = next_;
  next_ = after(next_, stamps);
  return frame;
}

RandomVictim::RandomVictim(std::uint32_t seed) : state_(core::mix(seed + std::uint64_t{1})) {}

/// A counter put through a hash; the upper half of the product is uniform below the count.
std::uint32_t RandomVictim::victim(Stamps stamps) {
  const std::uint64_t drawn = core::mix(++state_) >> 32U;
  return static_cast<std::uint32_t>((drawn * stamps.size()) >> 32U);
}

VictimChoice::Policy VictimChoice::make(LocalMemory& memory, Replacement replacement, std::uint32_t frame_count,
                                        std::uint32_t seed) {
  switch (replacement) {
    case Replacement::lru:
      return LeastRecentlyUsed(memory, frame_count);
    case Replacement::clock:
      return Clock();
    case Replacement::fifo:
      return FirstInFirstOut();
    case Replacement::random:
      return RandomVictim(seed);
  }
  core::expect(false, "a replacement policy is one of four");
  return Clock();
}

VictimChoice::VictimChoice(LocalMemory& memory, Replacement replacement, std::uint32_t frame_count, std::uint32_t seed)
    : policy_(make(memory, replacement, frame_count, seed)) {}

void VictimChoice::add_needs(nodes::MemoryPlan& plan, Replacement replacement, std::uint32_t frame_count) {
  if (replacement == Replacement::lru) {
    LeastRecentlyUsed::add_needs(plan, frame_count);
  }
}

}  // namespace dmpc::svm
