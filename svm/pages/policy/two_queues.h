// A queue for pages that are new, and a list for those that came back.
#pragma once

#include <cstdint>

#include "nodes/local_memory.h"
#include "svm/pages/policy/ghosts.h"
#include "svm/pages/policy/index_lists.h"
#include "svm/pages/policy/policy.h"

namespace dmpc::svm {

/// T. Johnson, D. Shasha, "2Q: A Low Overhead High Performance Buffer Management Replacement Algorithm" (VLDB 1994), the full
/// version: new pages leave in the order in which they came, and one that comes back while it is remembered stays until it is the
/// least recently used of those. A quarter of the frames is for new pages, half as many pages as there are frames are remembered.
class TwoQueues final : public ReplacementPolicy {
 public:
  explicit TwoQueues(const PolicySite& site);
  static nodes::MemoryPlan layout(std::uint32_t frame_count);

  void hit(PageId page, std::uint32_t frame) override;
  void insert(PageId page, std::uint32_t frame) override;
  std::uint32_t victim(PageId incoming) override;

 private:
  enum List : unsigned { new_ones, kept_ones };
  static std::uint32_t ghost_capacity(std::uint32_t frame_count);

  std::span<const PageId> pages_;
  std::uint32_t new_ones_max_;
  IndexLists frames_;  ///< A1in and Am
  Ghosts ghosts_;      ///< A1out
  bool comes_back_ = false;
};

}  // namespace dmpc::svm
