// How a node finds what a ray hits.
#pragma once

#include "core/picture/pixel_task.h"
#include "core/record/records.h"
#include "dataflow/regions/regions.h"
#include "nodes/node_id.h"

namespace dmpc::dataflow {

/// Our grid over a node's part of the database, in one of the node's regions at a time: rays walk in region(). All of them share
/// the part's records, so where a hit was found is the node's to say, not the region's.
class PartTracer : public core::GridTracer<core::LocalRecords> {
 public:
  /// Of a node that has no other region than the header's.
  PartTracer(core::LocalRecords& records, const core::DatabaseHeader& header, const core::Skips& skips)
      : GridTracer(records, header, skips) {}
  /// Of node `self`; `regions` outlive it, and the header's is one of the node's.
  PartTracer(core::LocalRecords& records, const core::DatabaseHeader& header, const core::Skips& skips, const Regions& regions,
             nodes::NodeId self)
      : GridTracer(records, header, skips), regions_(&regions), self_(self) {}

  /// Rays may be in others than region().
  bool has_several_regions() const { return regions_ != nullptr && regions_->region_count() > regions_->node_count(); }

  /// Goes to the node's region that holds a finest cell. False, and nothing done, if it has none there.
  bool enter(const core::Corner& cell) {
    if (region().contains(cell)) {
      return true;
    }
    if (regions_ == nullptr) {
      return false;
    }
    const std::uint32_t index = regions_->region_index_of(cell);
    if (regions_->owner_at(index) != self_) {
      return false;
    }
    move_to(regions_->region_at(index));
    return true;
  }

 private:
  const Regions* regions_ = nullptr;
  nodes::NodeId self_{};
};

}  // namespace dmpc::dataflow
