// Policies that read the time stamps of the cache: a page hit has no further cost.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/sampling.h"
#include "core/picture/memory_use.h"
#include "nodes/layout.h"
#include "nodes/local_memory.h"
#include "svm/pages/replacement.h"

namespace dmpc::svm {

/// The next frame, cyclically.
inline std::uint32_t frame_after(std::uint32_t frame, std::size_t frame_count) { return frame + 1 < frame_count ? frame + 1 : 0; }

/// Evicts the page that was referenced least recently, exactly. A search finds the oldest few at once, in order: as long as their
/// stamps have not changed they are the frames with the least stamps, since stamps only grow, so a frame that was not among the
/// oldest cannot become older than one that was.
class LeastRecentlyUsed final : public ReplacementPolicy {
  struct Candidate;

 public:
  explicit LeastRecentlyUsed(const PolicySite& site)
      : stamps_(site.stamps), candidates_(layout(site.frame_count()).in(site.memory)) {}

  static nodes::Room<Candidate> layout(std::uint32_t frame_count) {
    return {core::MemoryUse::page_table, std::min(frame_count, candidate_count_max)};
  }

  std::uint32_t victim(PageId /*incoming*/) override {
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

 private:
  struct Candidate {
    std::uint64_t stamp = 0;
    std::uint32_t frame = 0;
    std::uint32_t padding = 0;
  };
  /// One pass with a heap whose top is the youngest of the oldest. More would make a search more expensive, fewer would make
  /// searches more frequent.
  static constexpr std::uint32_t candidate_count_max = 64;

  void seek_candidates() {
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

  Stamps stamps_;
  std::span<Candidate> candidates_;  ///< the oldest frames at the last search, oldest first
  std::size_t candidate_count_ = 0, next_candidate_ = 0;
};

/// A hand goes round the frames and clears the reference mark of each that has one, until it finds one without (F. J. Corbato, "A
/// Paging Experiment with the Multics System", 1968). A new page has a mark. No memory of its own.
class Clock final : public ReplacementPolicy {
 public:
  explicit Clock(const PolicySite& site) : stamps_(site.stamps) {}
  std::uint32_t victim(PageId /*incoming*/) override {
    while (stamps_[hand_] != 0) {
      stamps_[hand_] = 0;
      hand_ = frame_after(hand_, stamps_.size());
    }
    const std::uint32_t frame = hand_;
    hand_ = frame_after(hand_, stamps_.size());
    return frame;
  }

 private:
  Stamps stamps_;
  std::uint32_t hand_ = 0;
};

/// Frames are filled in order, so the oldest page is always in the next frame, cyclically. No memory of its own.
class FirstInFirstOut final : public ReplacementPolicy {
 public:
  explicit FirstInFirstOut(const PolicySite& site) : frame_count_(site.frame_count()) {}
  std::uint32_t victim(PageId /*incoming*/) override {
    const std::uint32_t frame = next_;
    next_ = frame_after(next_, frame_count_);
    return frame;
  }

 private:
  std::uint32_t frame_count_;
  std::uint32_t next_ = 0;
};

/// Draws from a sequence that depends on the seed alone. With n frames the probabilities differ from 1/n by less than 2^-32. No
/// memory of its own.
class RandomVictim final : public ReplacementPolicy {
 public:
  explicit RandomVictim(const PolicySite& site)
      : frame_count_(site.frame_count()), state_(core::mix(site.seed + std::uint64_t{1})) {}

  /// A hashed counter; the upper half of the product is uniform below the count.
  std::uint32_t victim(PageId /*incoming*/) override {
    const std::uint64_t drawn = core::mix(++state_) >> 32U;
    return static_cast<std::uint32_t>((drawn * frame_count_) >> 32U);
  }

 private:
  std::uint64_t frame_count_;
  std::uint64_t state_;
};

}  // namespace dmpc::svm
