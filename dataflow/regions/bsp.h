// A partition of space into as many regions as nodes, by median planes, as one small value that every node holds.
//
// Source of the scheme: D. Badouel, K. Bouatouch, T. Priol, "Distributing Data and Control for Ray Tracing in Parallel", 1994:
// binary space partitioning with planes perpendicular to two axes, about equal loads on both sides.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "core/base/region.h"
#include "dataflow/regions/columns.h"
#include "nodes/node_id.h"

namespace dmpc::dataflow {

/// The maximum number of regions of a Bsp; its size follows.
inline constexpr std::uint32_t region_count_max = 4096;
static_assert(region_count_max >= nodes::node_count_max, "every node has a region");

/// The choice of the next cut's axis. The other axis is used where the chosen one has no cut left. Measured with 64 regions: the
/// mean of the average loads on rings-3-t1, teapot-12, mount-6-t6, tetra-9 and balls-4 is 85 % across the longer side and 84 %
/// alternating; but the boundaries, which rays cross, are shorter across the longer side: by 13 % on rings-3-t1, 20 % on
/// teapot-12, 35 % on mount-6-t6, 1 % on tetra-6 and 78 % on the flat balls-4.
enum class CutOrder : std::uint8_t {
  longer_axis,  ///< across the longer side of the box, the second cut axis when they are equal
  alternating   ///< the first cut axis, then the second, and so on: the article's order
};

struct BspOptions {
  CutOrder order = CutOrder::longer_axis;
  /// A cut that would miss its share by more than this part of one region's load on a lattice line is made inside the column,
  /// whose load is assumed to be uniform.
  double hot_spot_share = 1.0 / 32;
};

/// The regions of a run and their owners: every finest cell of the grid lies in exactly one region, and every region has one
/// node. Except for units (build_units()), every node has one region.
///
/// Invariants: regions are numbered 0 .. region_count() - 1 from the low side of every cut to the high side. A box of n regions
/// is cut into floor(n / 2) and ceil(n / 2), so the tree's form follows from the count alone, and the cut between regions i and i
/// + 1, at any depth, is stored at index i. With units a box of n nodes is cut in this way, and then a node's box, by halves.
/// Immutable except for assign(), give_to() and mark_empty(); as plain bytes copyable to every node.
class Bsp {
 public:
  /// One region: the grid of `grid_size` finest cells, owned by node 0.
  explicit Bsp(const core::Corner& grid_size) : grid_size_(grid_size) {}

  std::uint32_t region_count() const { return region_count_; }
  std::uint32_t node_count() const { return node_count_; }
  /// Whether a node has several regions, and may migrate them.
  bool is_of_units() const { return node_count_ < region_count_; }
  /// In finest cells.
  const core::Corner& grid_size() const { return grid_size_; }
  /// The region of a finest cell of the grid: at most ceil(log2(region_count())) comparisons.
  std::uint32_t region_index_of(const core::Corner& cell) const;
  /// The region with its box, by one descent of the tree.
  FoundRegion find(const core::Corner& cell) const;
  /// The box of region `index`, in finest cells; empty only if there are more regions than finest columns to share.
  core::Region region_at(std::uint32_t index) const;

  /// Regions with consecutive numbers that make up a box.
  struct Leaf {
    core::Region box;
    std::uint32_t first = 0, count = 0;
  };
  /// The largest leaf around region `index` that is bounded by cuts or the grid's border, and whose regions all have its owner.
  Leaf leaf_around(std::uint32_t index) const;
  /// Whether all of the leaf's regions are `node`'s.
  bool owns(nodes::NodeId node, const Leaf& leaf) const;

  /// A plane between regions, in four bytes.
  class Cut {
   public:
    constexpr Cut() = default;
    /// `at`: the first finest index of the high side, below 2^29; `axis`: 0, 1 or 2.
    constexpr Cut(std::int32_t at, std::int32_t axis) : at_and_axis_(at * 4 + axis) {}
    constexpr std::int32_t at() const { return at_and_axis_ >> 2; }
    constexpr std::size_t axis() const { return static_cast<std::size_t>(at_and_axis_ & 3); }

   private:
    std::int32_t at_and_axis_ = 0;
  };
  /// Calls visit(cut, is_high) for every cut above region `index`, the outermost first; is_high: its side of the cut.
  template <class Visit>
  void for_each_cut(std::uint32_t index, Visit visit) const;
  /// The cut between region `index` and the next. Every cut is between two such regions.
  Cut cut_after(std::uint32_t index) const {
    core::expect(index + 1 < region_count_, "a cut has a region on either side");
    return cuts_[index];
  }

  /// The owner of region `index`.
  nodes::NodeId owner_at(std::uint32_t index) const { return nodes::NodeId{owner_[index]}; }
  /// The owner of a finest cell of the grid.
  nodes::NodeId owner_of(const core::Corner& cell) const { return owner_at(region_index_of(cell)); }
  /// The number of the region that `node` owns. Requires that it owns one.
  std::uint32_t region_index_of(nodes::NodeId node) const;

  /// Whether region `index` is known to be empty.
  bool is_empty(std::uint32_t index) const { return (empty_[index / 64] >> (index % 64) & 1U) != 0; }
  /// Marks region `index` as empty: rays need not go to its owner.
  void mark_empty(std::uint32_t index) { empty_[index / 64] |= std::uint64_t{1} << (index % 64); }

  /// Gives region i to node node_of_region[i]; expects a permutation of 0 .. region_count() - 1. Before the call, region i is
  /// node i's.
  void assign(std::span<const std::uint32_t> node_of_region);
  /// These regions before they were cut into units: one per node, numbered by node.
  Bsp without_units() const;
  /// These units, as if each were the region of a node of its number. Only those whose owner holds nothing at all are marked as
  /// empty: rays start where they would if nodes had one region, as when loads were measured.
  Bsp by_unit() const;
  /// Changes the owner of region `index`.
  void give_to(std::uint32_t index, nodes::NodeId node) { owner_[index] = static_cast<std::uint16_t>(nodes::index_of(node)); }

 private:
  friend class BspBuilder;

  /// The number of a box's `count` regions on the low side of its cut.
  std::uint32_t low_count_of(std::uint32_t count) const {
    if (units_each_ == 1) {
      return count / 2;  // the same, without a division
    }
    return count > units_each_ ? count / units_each_ / 2 * units_each_ : count / 2;
  }

  core::Corner grid_size_;
  std::uint32_t region_count_ = 1;
  std::uint32_t node_count_ = 1;
  std::uint32_t units_each_ = 1;
  std::array<Cut, region_count_max - 1> cuts_{};
  std::array<std::uint16_t, region_count_max> owner_{};
  std::array<std::uint64_t, region_count_max / 64> empty_{};  ///< a bit a region
};
static_assert(std::is_trivially_copyable_v<Bsp>);

template <class Visit>
void Bsp::for_each_cut(std::uint32_t index, Visit visit) const {
  core::expect(index < region_count_, "a region has a number below the count");
  std::uint32_t first = 0, count = region_count_;
  while (count > 1) {
    const std::uint32_t low_count = low_count_of(count);
    const bool is_high = index >= first + low_count;
    visit(cuts_[first + low_count - 1], is_high);
    first += is_high ? low_count : 0;
    count = is_high ? count - low_count : low_count;
  }
}

/// Regions of about equal load. Throws core::UsageError unless 1 <= region_count <= region_count_max. Columns without load count
/// a little by their area, so that zero loads give regions of equal size.
Bsp build_bsp(const ColumnLoads& loads, std::uint32_t region_count, const BspOptions& options = {});
/// The regions that build_bsp() gives `node_count` nodes, each cut into `units_a_node` of about equal load, all owned by its
/// node: numbers i * units_a_node and on are those of region i.
Bsp build_units(const ColumnLoads& loads, std::uint32_t node_count, std::uint32_t units_a_node, const BspOptions& options = {});

/// The naive split: regions of equal size, whatever is in them.
Bsp equal_size_bsp(const core::Corner& grid_size, const CutAxes& axes, std::uint32_t region_count,
                   const BspOptions& options = {});

/// The load of each region, by region number; a column that is cut gives each side its share of the area.
std::vector<double> loads_of_regions(const Bsp& bsp, const ColumnLoads& loads);

/// Mean over maximum, in (0, 1]: the share of time that the regions' nodes are busy if nothing else costs time. 1 if there is no
/// load.
double average_load(std::span<const double> loads);

/// Two regions that share a face.
struct Boundary {
  std::uint32_t low = 0, high = 0;  ///< region numbers, low < high
  /// The face's extent along the cut axis that it lies in; along the third axis all span the grid.
  std::int32_t length_cells = 0;
  constexpr bool operator==(const Boundary&) const = default;
};

/// The connectivity graph: every pair of regions that share a face of positive length, ascending by (low, high).
std::vector<Boundary> boundaries_of(const Bsp& bsp, const CutAxes& axes);

}  // namespace dmpc::dataflow
