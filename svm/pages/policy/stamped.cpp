#include "svm/pages/policy/stamped.h"

#include <algorithm>

#include "core/base/sampling.h"
#include "core/picture/memory_use.h"

namespace dmpc::svm {
namespace {

/// More would make a search dearer, fewer would make searches more frequent.
constexpr std::uint32_t candidate_count_max = 64;

std::uint32_t after(std::uint32_t frame, std::size_t frame_count) { return frame + 1 < frame_count ? frame + 1 : 0; }

}  // namespace

nodes::Room<LeastRecentlyUsed::Candidate> LeastRecentlyUsed::layout(std::uint32_t frame_count) {
  return {core::MemoryUse::page_table, std::min(frame_count, candidate_count_max)};
}

LeastRecentlyUsed::LeastRecentlyUsed(const PolicySite& site)
    : stamps_(site.stamps), candidates_(layout(site.frame_count()).in(site.memory)) {}

std::uint32_t LeastRecentlyUsed::victim(PageId /*incoming*/) {
  while (true) {
    while (next_candidate_ < candidate_count_) {
      const Candidate& candidate = candidates_[next_candidate_++];
      if (stamps_[candidate.frame] == candidate.stamp) {
        return candidate.frame;
      }
    }
    seek_candidates();
  }
}

/// One pass with a heap whose top is the youngest of the oldest.
void LeastRecentlyUsed::seek_candidates() {
  const auto older = [](const Candidate& a, const Candidate& b) { return a.stamp < b.stamp; };
  const auto begin = candidates_.begin();
  auto end = begin;
  for (std::uint32_t frame = 0; frame < stamps_.size(); ++frame) {
    if (end != candidates_.end()) {
      *end++ = {stamps_[frame], frame};
      std::push_heap(begin, end, older);
    } else if (stamps_[frame] < begin->stamp) {
      std::pop_heap(begin, end, older);
      *(end - 1) = {stamps_[frame], frame};
      std::push_heap(begin, end, older);
    }
  }
  std::sort_heap(begin, end, older);
  candidate_count_ = static_cast<std::size_t>(end - begin);
  next_candidate_ = 0;
}

std::uint32_t Clock::victim(PageId /*incoming*/) {
  while (stamps_[hand_] != 0) {
    stamps_[hand_] = 0;
    hand_ = after(hand_, stamps_.size());
  }
  const std::uint32_t frame = hand_;
  hand_ = after(hand_, stamps_.size());
  return frame;
}

std::uint32_t FirstInFirstOut::victim(PageId /*incoming*/) {
  const std::uint32_t frame = next_;
  next_ = after(next_, frame_count_);
  return frame;
}

RandomVictim::RandomVictim(const PolicySite& site)
    : frame_count_(site.frame_count()), state_(core::mix(site.seed + std::uint64_t{1})) {}

/// A counter put through a hash; the upper half of the product is uniform below the count.
std::uint32_t RandomVictim::victim(PageId /*incoming*/) {
  const std::uint64_t drawn = core::mix(++state_) >> 32U;
  return static_cast<std::uint32_t>((drawn * frame_count_) >> 32U);
}

}  // namespace dmpc::svm
