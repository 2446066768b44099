// A node's tracer.
#pragma once

#include "core/picture/pixel_task.h"
#include "core/record/records.h"
#include "dataflow/regions/regions.h"
#include "dataflow/units/unit_pages.h"
#include "nodes/node_id.h"

namespace dmpc::dataflow {

/// Our grid over a node's part of the database, in one of the node's regions at a time: rays traverse region(). All regions share
/// the part's records, so a hit's address is valid for the node, not the region.
class PartTracer : public core::GridTracer<PartRecords> {
 public:
  /// For a node that has only the header's region.
  PartTracer(PartRecords& records, const core::DatabaseHeader& header, const core::Skips& skips)
      : GridTracer(records, header, skips) {}
  /// For node `self`; `regions` outlive it, and the header's is one of the node's.
  PartTracer(PartRecords& records, const core::DatabaseHeader& header, const core::Skips& skips, const Regions& regions,
             nodes::NodeId self)
      : GridTracer(records, header, skips), regions_(&regions), self_(self) {}

  /// Whether rays may be in other regions than region().
  bool has_several_regions() const { return regions_ != nullptr && regions_->region_count() > regions_->node_count(); }

  /// Moves to the node's region that holds a finest cell; if regions move, to the largest leaf of the node's around it, so that
  /// rays traverse it as if the leaf had not been cut. Returns false, without moving, if the node has no region there.
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
  /// Moves there for a ray that was taken up when the region was the node's. If regions move it may have been migrated since, but
  /// all its records are still here.
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
  /// Whether no unit of the leaf that rays traverse has been migrated since.
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
  Bsp::Leaf leaf_;  ///< if regions move; without regions until rays traverse one
};

}  // namespace dmpc::dataflow
