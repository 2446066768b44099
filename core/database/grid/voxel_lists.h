// The records that voxels list, and their lists.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/database/conversion.h"
#include "core/database/grid/macro_cells.h"
#include "core/database/record_writer.h"
#include "core/database/structure.h"
#include "core/database/tree/leaf_writer.h"

namespace dmpc::core {

/// Each polygon, sphere and cone has a leaf of its own, of a polygon the triangles: up to 8, and another leaf for each 8 more,
/// or for others of its planes. A voxel lists a leaf once. What it is made from outlives it.
class VoxelLists {
 public:
  VoxelLists(const MacroCells& voxels, const Conversion& conversion, const VoxelRule& rule);

  /// The lengths of all lists.
  std::uint64_t references() const { return listed_.size(); }

  /// Takes room for the leaves, where the room for normals has been taken.
  void take_room(const Conversion& conversion, RecordWriter& writer);
  /// Writes them, and the references from `references` on, for which room has been taken and made; enters each list in a
  /// directory of `size` voxels.
  void write(const Conversion& conversion, Address references, RecordWriter& writer);
  void enter(const std::array<std::int32_t, 3>& size, std::span<DirectoryEntry> directory) const;
  void count(RecordCounts& records) const;

 private:
  struct Leaf {
    LeafShape shape;
    std::uint32_t first;  ///< id; the others follow
    Address address = no_address;
  };

  void make_leaves(const Conversion& conversion);
  std::size_t share_of(const Leaf& leaf, const Conversion& conversion) const;
  void sort_by_place();

  const MacroCells& voxels_;
  VoxelRule rule_;
  std::vector<Leaf> leaves_;              ///< in the order of ids
  std::vector<std::uint32_t> leaf_of_;    ///< by id
  std::vector<std::uint32_t> order_;      ///< of leaves, in pages
  std::vector<std::uint32_t> listed_;     ///< leaves, list by list
  std::vector<std::uint64_t> list_ends_;  ///< of the voxels'
};

}  // namespace dmpc::core
