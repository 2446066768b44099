// Builds the bricks below one top cell: which voxels, which blocks, which nested bricks.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/box.h"
#include "core/database.h"
#include "core/record_writer.h"
#include "core/region.h"

namespace dmpc::core {

/// Ids sorted into the 64 voxels of a brick; ids of a voxel ascend.
struct VoxelLists {
  std::array<std::uint32_t, 65> start{};
  std::vector<std::uint32_t> ids;

  std::span<const std::uint32_t> of(std::size_t voxel) const {
    return std::span(ids).subspan(start[voxel], start[voxel + 1] - start[voxel]);
  }
};

/// Serial; one builder a database.
class BrickBuilder {
 public:
  BrickBuilder(std::span<const PrimitiveValues> primitives, std::span<const ShadingReference> shading, double pad,
               float finest_cell, int voxel_primitives_max, RecordWriter& writer);

  /// The brick of the top cell at `corner`; `ids`, ascending, are the primitives that touch it.
  Address build_top(const Corner& corner, std::span<const std::uint32_t> ids);

  std::span<const Database::Place> places() const { return places_; }
  std::uint64_t references() const { return references_; }

 private:
  VoxelLists split(int level, const Corner& corner, std::span<const std::uint32_t> ids) const;
  bool worth_nesting(int voxel_level, std::span<const std::uint32_t> ids, const VoxelLists& inner) const;
  bool promising(int voxel_level, const Corner& corner, std::span<const std::uint32_t> ids) const;
  /// Up to 8 blocks, and for each voxel which of them have a primitive in it.
  struct Sheet {
    std::vector<std::span<const std::uint32_t>> blocks;
    std::array<std::uint8_t, 64> mask{};
  };

  Address build(int level, const Corner& corner, const VoxelLists& lists);
  std::vector<Sheet> cut_into_sheets(const VoxelLists& lists, std::uint64_t nested, std::span<std::uint32_t> ids);
  static std::size_t sheet_bytes(std::uint64_t occupied, std::uint64_t nested, const Sheet& sheet);
  std::vector<Address> write_blocks(const Sheet& sheet);
  Address write_further_sheets(std::span<const Sheet> sheets);
  void write_sheet(Address address, Brick brick, const Sheet& sheet, std::span<const Address> blocks,
                   std::span<const Address> children);
  void sort_for_blocks(const Box& box, std::vector<std::uint32_t>& ids) const;
  Address write_block(std::span<const std::uint32_t> ids);

  std::span<const PrimitiveValues> primitives_;
  std::span<const ShadingReference> shading_;
  double pad_;
  double finest_cell_;
  std::size_t voxel_primitives_max_;
  RecordWriter* writer_;
  std::vector<Database::Place> places_;
  std::vector<std::uint32_t> block_of_;  ///< scratch: the block of each primitive in the brick being built
  std::uint64_t references_ = 0;
};

}  // namespace dmpc::core
