// Three queues: a small one that most pages only pass through, a main one, and one of names.
#pragma once

#include <cstdint>
#include <span>

#include "nodes/local_memory.h"
#include "svm/pages/policy/ghosts.h"
#include "svm/pages/policy/index_lists.h"
#include "svm/pages/policy/policy.h"

namespace dmpc::svm {

/// J. Yang, Y. Zhang, Z. Qiu, Y. Yue, R. Vinayak, "FIFO Queues are All You Need for Cache Eviction" (SOSP 2023), algorithm 1
/// (S3-FIFO), for pages, which are of one size: a tenth of the frames is the small queue's, and as many pages are remembered as
/// the main queue has frames. One page leaves for one that comes.
class SmallAndMain final : public ReplacementPolicy {
 public:
  explicit SmallAndMain(const PolicySite& site);
  static nodes::MemoryPlan layout(std::uint32_t frame_count);

  void hit(PageId page, std::uint32_t frame) override;
  void insert(PageId page, std::uint32_t frame) override;
  std::uint32_t victim(PageId incoming) override;

 private:
  enum List : unsigned { small, main };
  static std::uint32_t small_frames(std::uint32_t frame_count);
  static std::uint32_t ghost_capacity(std::uint32_t frame_count);

  std::uint32_t leave_small();
  std::uint32_t leave_main();

  std::span<const PageId> pages_;
  std::uint32_t small_max_, main_max_;
  IndexLists frames_;
  Ghosts ghosts_;
  std::span<std::uint8_t> hits_;  ///< of each frame's page, up to 3
  bool comes_back_ = false;
};

}  // namespace dmpc::svm
