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

/// Primitives of one kind, either all or none of which need a plane in their records: a range of a Cutter's lists.
struct Group {
  std::uint32_t first = 0, last = 0;
  /// Beginning of the sorted group of which this small group is a part.
  std::uint32_t base = 0;
  bool is_sorted = false;
  bool needs_plane = false;
  PrimitiveKind kind{};
  Bounds bounds;  ///< around all primitives

  std::uint32_t count() const { return last - first; }
};

/// Holds primitives and cuts groups of them in two: large groups between bins, small ones, which are sorted once along each axis,
/// at the best of all positions. Thread safety: groups without common primitives may be cut at the same time.
class Cutter {
 public:
  /// Holds up to `count` primitives. `primitives`: all, by id, for the planes of those that need one.
  explicit Cutter(std::size_t count, std::span<const PrimitiveValues> primitives = {}, VectorWidth width = vector_width());

  /// Appends a primitive; those of one kind are consecutive.
  void add(std::uint32_t id, const Bounds& bounds);
  /// The group of a range.
  Group group(PrimitiveKind kind, std::size_t first, std::size_t last, bool needs_plane = false) const;
  /// Whether a group is as small as a leaf, and of one plane if it needs that.
  bool fits_leaf(const Group& group) const { return group.count() <= leaf_lanes && (!group.needs_plane || lies_in_one(group)); }
  /// PrimitiveValues::plane() of the first of a group that needs planes.
  std::uint32_t plane_of(const Group& group) const { return group.needs_plane ? plane_at(group, group.first) : 0; }

  /// Cuts a group of at least two in two, neither of them empty. A group as small as a leaf is cut between planes. `balanced`:
  /// into equal numbers, at any cost.
  std::pair<Group, Group> cut(Group whole, bool balanced);

  /// Restores the order of a sorted group after cuts, so that it can be cut again; does nothing for another one.
  void sort_again(const Group& group);

  /// Copies the primitives of a group, in arbitrary order.
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
  std::array<std::vector<std::uint8_t>, 3> orders_;  ///< for sorted groups, by axis: offsets from the group's base
};

}  // namespace dmpc::core
