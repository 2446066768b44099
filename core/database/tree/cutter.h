// Cuts the primitives of a macro cell into groups, by the surface area heuristic.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/base/box.h"
#include "core/base/vector_width.h"
#include "core/database/database.h"
#include "core/record/record.h"

namespace dmpc::core {

/// Primitives of one kind, all of which need a plane in their records or none of which does: those between two places of a
/// Cutter's lists.
struct Group {
  std::uint32_t first = 0, last = 0;
  /// Where the group that was sorted, and which this small group is a part of, began.
  std::uint32_t base = 0;
  bool is_sorted = false;
  bool needs_plane = false;
  PrimitiveKind kind{};
  Bounds bounds;  ///< of all

  std::uint32_t count() const { return last - first; }
};

/// Holds primitives and cuts groups of them in two: large groups between bins, small ones, which are sorted once along each axis,
/// at the best of all places. Thread safety: groups that share no primitive may be cut at the same time.
class Cutter {
 public:
  /// Room for `count` primitives. `primitives`, by id, tell the planes of those that need one.
  explicit Cutter(std::size_t count, std::span<const PrimitiveValues> primitives = {}, VectorWidth width = vector_width());

  /// Appends a primitive; those of one kind come one behind the other.
  void add(std::uint32_t id, const Bounds& bounds);
  /// All between two places.
  Group group(PrimitiveKind kind, std::size_t first, std::size_t last, bool needs_plane = false) const;
  /// Whether a group is as small as a leaf, and of one plane if it needs that.
  bool fits_leaf(const Group& group) const { return group.count() <= leaf_lanes && (!group.needs_plane || lies_in_one(group)); }
  /// PrimitiveValues::plane() of the first of a group that needs planes.
  std::uint32_t plane_of(const Group& group) const { return group.needs_plane ? plane_at(group, group.first) : 0; }

  /// Two groups, none of them empty, of a group of at least two. One as small as a leaf is cut between planes. `balanced`: of
  /// equal numbers, whatever a ray pays for it.
  std::pair<Group, Group> cut(Group whole, bool balanced);

  /// Undoes what cuts did to the order of a sorted group, so that it can be cut anew; nothing of another one.
  void sort_again(const Group& group);

  /// The primitives of a group, in no order that means anything.
  void copy_ids(const Group& group, std::span<std::uint32_t> ids) const;

 private:
  std::uint32_t item_at(const Group& group, std::size_t axis, std::uint32_t place) const;
  Bounds bounds_of(const Group& group) const;
  std::pair<Group, Group> halves(const Group& whole, std::uint32_t middle) const;
  void sort(Group& group);
  std::uint32_t cut_sorted(const Group& whole, bool balanced);
  void divide(const Group& whole, std::uint64_t is_first);
  std::uint32_t cut_between_planes(const Group& whole);
  std::uint32_t plane_at(const Group& group, std::uint32_t place) const;
  bool lies_in_one(const Group& group) const;
  std::pair<Group, Group> cut_between_bins(const Group& whole);
  std::uint32_t cut_in_the_middle(const Group& whole);
  template <class IsFirst>
  std::uint32_t partition(const Group& whole, const IsFirst& is_first);

  std::span<const PrimitiveValues> primitives_;
  VectorWidth width_;
  std::vector<std::uint32_t> ids_;
  std::vector<Bounds> bounds_;
  std::array<std::vector<std::uint8_t>, 3> orders_;  ///< of sorted groups, by axis: places behind the group's base
};

}  // namespace dmpc::core
