// Pages seen once beside pages seen again, with a border that learns.
#pragma once

#include <cstdint>

#include "nodes/local_memory.h"
#include "svm/pages/policy/ghosts.h"
#include "svm/pages/policy/index_lists.h"
#include "svm/pages/policy/policy.h"

namespace dmpc::svm {

/// N. Megiddo, D. S. Modha, "ARC: A Self-Tuning, Low Overhead Replacement Cache" (FAST 2003), figure 4; its p is a whole number
/// here. As many pages that have left are remembered as there are frames.
class AdaptiveReplacement final : public ReplacementPolicy {
 public:
  explicit AdaptiveReplacement(const PolicySite& site);
  static nodes::MemoryPlan layout(std::uint32_t frame_count);

  void hit(PageId page, std::uint32_t frame) override;
  void insert(PageId page, std::uint32_t frame) override;
  std::uint32_t victim(PageId incoming) override;

 private:
  enum List : unsigned { once, again };

  void learn(unsigned ghost_list, std::uint32_t once_ghosts, std::uint32_t again_ghosts);
  void forget_one();
  std::uint32_t replace(bool was_again);

  std::span<const PageId> pages_;
  std::uint32_t frame_count_;
  IndexLists frames_;              ///< T1 and T2
  Ghosts ghosts_;                  ///< B1 and B2
  std::uint32_t once_target_ = 0;  ///< p: frames that pages seen once should have
  bool comes_back_ = false;        ///< the page that is inserted next was remembered
};

}  // namespace dmpc::svm
