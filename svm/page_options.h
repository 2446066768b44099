// What a run with pages may choose: options, runs and plans have it as a member.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "svm/replacement.h"

namespace dmpc::svm {

class ReferenceLog;

/// Of svm and, as far as no page travels, of replicated. `optional` without a value means: choose.
struct PageOptions {
  /// Frames of each node's cache; svm only. With a memory bound and without this, the cache takes all that is left.
  std::optional<std::uint32_t> cache_pages = std::nullopt;
  Replacement replacement = Replacement::lru;  ///< which page of the cache makes room; svm only
  /// Pixels under way on a node. Without it 16 for svm: a node whose pixel waits for a page has others to go on with, while
  /// the stacks and reply slots of 16 pixels take about 1 % of a 4 MiB node; and 1 for replicated, where nothing is ever
  /// waited for.
  std::optional<std::uint32_t> in_flight = std::nullopt;
  std::uint32_t work_item_side = 3;  ///< pixels along the side of a work item; 0: no node gives work to another
  bool count_pages = false;          ///< the distinct pages of each pixel; costs a bit a page for each pixel in flight
  /// Record every node's page references, run_svm() only: an instrument, whose memory is no node's and grows with the run. Needs
  /// work_item_side = 0 and in_flight = 1, else the references would depend on the cache and the schedule. Not with count_pages.
  bool record_references = false;
  /// One for each node, where run_svm() notes what the node references, in whatever order it comes, unless different pages are
  /// counted. Outlive the run.
  std::vector<ReferenceLog>* reference_logs = nullptr;
};

}  // namespace dmpc::svm
