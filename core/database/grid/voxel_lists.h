// The leaves that voxels list, and their lists.
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

/// Each polygon, sphere and cone has its own leaf; a polygon's has its triangles: up to 8, with another leaf for each 8 more, or
/// for other planes. A voxel lists a leaf once. The constructor's arguments outlive it.
class VoxelLists {
 public:
  VoxelLists(const MacroCells& voxels, const Conversion& conversion, const VoxelRule& rule);

  /// The lengths of all lists.
  std::uint64_t references() const { return listed_.size(); }

  /// Allocates the leaves; normals have been allocated.
  void take_room(const Conversion& conversion, RecordWriter& writer);
  /// Writes them, and the references from `references` on, which have been allocated and made writable; enters each list in a
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
  std::vector<std::uint32_t> order_;      ///< leaves in the order of pages
  std::vector<std::uint32_t> listed_;     ///< leaves, list by list
  std::vector<std::uint64_t> list_ends_;  ///< by voxel
};

}  // namespace dmpc::core
