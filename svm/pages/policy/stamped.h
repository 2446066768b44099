// Policies that read the time stamps which the cache writes: a page hit costs them nothing of their own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "nodes/layout.h"
#include "nodes/local_memory.h"
#include "svm/pages/policy/policy.h"

namespace dmpc::svm {

/// The page that was referenced least recently, exactly. A search yields the oldest few at once, in order: as long as their
/// stamps have not changed they are the frames with the least stamps of all, for stamps only grow, so a frame that was not among
/// the oldest cannot become older than one that was.
class LeastRecentlyUsed final : public ReplacementPolicy {
  struct Candidate;

 public:
  explicit LeastRecentlyUsed(const PolicySite& site);
  static nodes::Room<Candidate> layout(std::uint32_t frame_count);
  std::uint32_t victim(PageId incoming) override;

 private:
  struct Candidate {
    std::uint64_t stamp = 0;
    std::uint32_t frame = 0;
    std::uint32_t padding = 0;
  };
  void seek_candidates();

  Stamps stamps_;
  std::span<Candidate> candidates_;  ///< the oldest frames at the last search, oldest first
  std::size_t candidate_count_ = 0, next_candidate_ = 0;
};

/// A hand goes round the frames and takes the mark of a reference from each that has one, until it finds one without (F. J.
/// Corbato, "A Paging Experiment with the Multics System", 1968). A page that has just come has a mark. No memory of its own.
class Clock final : public ReplacementPolicy {
 public:
  explicit Clock(const PolicySite& site) : stamps_(site.stamps) {}
  std::uint32_t victim(PageId incoming) override;

 private:
  Stamps stamps_;
  std::uint32_t hand_ = 0;
};

/// Frames are filled in their order, so the page that came first is always the next one round. No memory of its own.
class FirstInFirstOut final : public ReplacementPolicy {
 public:
  explicit FirstInFirstOut(const PolicySite& site) : frame_count_(site.frame_count()) {}
  std::uint32_t victim(PageId incoming) override;

 private:
  std::uint32_t frame_count_;
  std::uint32_t next_ = 0;
};

/// Draws from a sequence that depends on the seed alone. With n frames the chances differ from 1/n by less than 2^-32. No memory
/// of its own.
class RandomVictim final : public ReplacementPolicy {
 public:
  explicit RandomVictim(const PolicySite& site);
  std::uint32_t victim(PageId incoming) override;

 private:
  std::uint64_t frame_count_;
  std::uint64_t state_;
};

}  // namespace dmpc::svm
