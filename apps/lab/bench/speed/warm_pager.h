// One node's part of svm's shared memory, by itself, with every page of the database at home or in its cache.
#pragma once

#include <cstdint>

#include "core/database/database.h"
#include "core/picture/pixel_task.h"
#include "nodes/local_memory.h"
#include "nodes/node.h"
#include "svm/pages/pager.h"
#include "svm/plan.h"

namespace dmpc::apps {

/// Takes each page from the database as if its home had replied; afterwards no page is absent. The node is one of `node_count`,
/// so all pages except that share are in the cache. Not thread-safe.
class WarmPager {
 public:
  WarmPager(const core::Database& database, const core::RenderSettings& settings, std::uint32_t node_count = 8);
  WarmPager(const WarmPager&) = delete;
  WarmPager& operator=(const WarmPager&) = delete;

  /// Returns the pager with which the nodes of a run look pages up, including counters.
  svm::Pager& pager() { return pager_; }

 private:
  /// Discards requests: the replies are at hand.
  class Nowhere final : public nodes::Network {
   public:
    void deliver(nodes::NodeId, const nodes::PacketHeader&, std::span<const std::byte>) override {}
  };

  void fetch(const core::Database& database, svm::PageId page);

  svm::Plan plan_;
  Nowhere network_;
  nodes::LocalMemory memory_;
  nodes::Node node_;
  svm::Pager pager_;
};

}  // namespace dmpc::apps
