// How a node finds what a ray hits.
#pragma once

#include "core/picture/pixel_task.h"
#include "core/record/records.h"
#include "dataflow/regions/regions.h"
#include "dataflow/units/unit_pages.h"
#include "nodes/node_id.h"

namespace dmpc::dataflow {

/// Our grid over a node's part of the database, in one of the node's regions at a time: rays walk in region(). All of them share
/// the part's records, so where a hit was found is the node's to say, not the region's.
class PartTracer : public core::GridTracer<PartRecords> {
 public:
  /// For a node that has no other region than the header's.
  PartTracer(PartRecords& records, const core::DatabaseHeader& header, const core::Skips& skips)
      : GridTracer(records, header, skips) {}
  /// For node `self`; `regions` outlive it, and the header's is one of the node's.
  PartTracer(PartRecords& records, const core::DatabaseHeader& header, const core::Skips& skips, const Regions& regions,
             nodes::NodeId self)
      : GridTracer(records, header, skips), regions_(&regions), self_(self) {}

  /// Rays may be in others than region().
  bool has_several_regions() const { return regions_ != nullptr && regions_->region_count() > regions_->node_count(); }

  /// Goes to the node's region that holds a finest cell; where regions move, to the largest leaf of the node's around it, so
  /// that rays walk as they would if the leaf had not been cut. False, and nothing done, if it has none there.
  bool enter(const core::Corner& cell) {
    if (regions_ == nullptr || (region().contains(cell) && is_leaf_whole())) {
      return region().contains(cell);
    }
    const std::uint32_t index = regions_->region_index_of(cell);
    if (regions_->owner_at(index) != self_) {
      return false;
    }
    go_to(index);
    return true;
  }
  /// Goes there for a ray that was taken up when the region was the node's. Where regions move it may have been migrated
  /// since, but all its records are still here.
  bool enter_taken_up(const core::Corner& cell) {
    const bool is_here = enter(cell);
    if (is_here || regions_ == nullptr || !regions_->are_moving()) {
      return is_here;
    }
    leaf_ = {regions_->region_at(regions_->region_index_of(cell)), 0, 0};
    move_to(leaf_.box);
    return true;
  }

 private:
  /// No unit of the leaf in which rays walk has been migrated since.
  bool is_leaf_whole() const { return !regions_->are_moving() || (leaf_.count > 0 && regions_->bsp()->owns(self_, leaf_)); }
  void go_to(std::uint32_t index) {
    if (regions_->are_moving()) {
      leaf_ = regions_->bsp()->leaf_around(index);
      move_to(leaf_.box);
    } else {
      move_to(regions_->region_at(index));
    }
  }

  const Regions* regions_ = nullptr;
  nodes::NodeId self_{};
  Bsp::Leaf leaf_;  ///< where regions move; without regions until rays walk in one
};

}  // namespace dmpc::dataflow
