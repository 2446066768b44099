#include "core/picture/camera/background.h"

#include <bit>

#include "core/database/meshes/placed_boxes.h"
#include "core/database/tree/leaf_values.h"
#include "core/database/tree/overlap.h"
#include "core/record/directory.h"
#include "core/record/records.h"
#include "core/record/sky.h"

namespace dmpc::core {
namespace {

/// BVH nodes and leaves that project to at most this many tiles count as filling them: testing their contents takes longer than
/// the tiles found empty would save. With this limit a picture of tetra-9 has 1 % fewer empty tiles, found in 60 % of the time.
constexpr int few_tiles_of_bvh_node = 6, few_tiles_of_leaf = 16;

std::uint32_t count_of(std::uint64_t bits) { return static_cast<std::uint32_t>(std::popcount(bits)); }

int tile_count(const TileFootprint& footprint) { return std::popcount(footprint.rows) * std::popcount(footprint.columns); }

Box box_of_cell(const Corner& corner, const GridFrame& frame) {
  Box box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.low[axis] = plane_at(frame, axis, corner[axis]);
    box.high[axis] = plane_at(frame, axis, corner[axis] + finest_per_macro);
  }
  return box;
}

/// Clears the bits of tiles that boxes project to.
class Finder {
 public:
  Finder(const Database& database, const BoxProjector& projector)
      : header_(database.header()),
        records_(database.bytes()),
        projector_(projector),
        pad_{database.pad(), database.pad(), database.pad()} {
    const TileFootprint all = projector.all();
    for (std::uint32_t row = 0; row < tiles_per_side; ++row) {
      bits_[row] = (all.rows >> row & 1U) != 0 ? all.columns : 0;
    }
    left_ = static_cast<std::uint32_t>(tile_count(all));
  }

  BackgroundTiles::Bits find() {
    for_each_macro_cell({}, grid_size(header_.frame), false, [this](const Corner& cell) { look_into_cell(cell); });
    return bits_;
  }

 private:
  void look_into_cell(const Corner& corner) {
    const DirectoryEntry entry = entry_of(header_, corner, [this](Address address) { return records_.find(address); });
    if (!entry.empty() && falls_on_any(projector_.footprint_of(box_of_cell(corner, header_.frame)))) {
      header_.has_voxels() ? look_into_voxel(entry, corner) : look_into_bvh_node(entry.bvh_node());
    }
  }

  /// A ray is tested against all that a voxel lists, but hits it within its box, and reaches it through the voxel.
  void look_into_voxel(const DirectoryEntry& entry, const Corner& corner) {
    const TileFootprint footprint = projector_.footprint_of(box_of_cell(corner, header_.frame));
    if (tile_count(footprint) <= few_tiles_of_bvh_node) {
      take_away(footprint);
    } else {
      for_each_listed(records_, header_, entry, [&](Address leaf) { look_into_leaf(leaf, footprint); });
    }
  }

  /// A ray reaches a child only through the boxes above it, so a box that projects to no tile with a bit need not be opened.
  void look_into_bvh_node(Address address) {
    const auto bvh_node = read<BvhNode>(records_.find(address));
    for (std::size_t child = 0; child < bvh_node.child_count && left_ > 0; ++child) {
      const TileFootprint footprint = projector_.footprint_of(box_of(bvh_node, child));
      const bool is_leaf = bvh_node.child[child].is_leaf();
      if (tile_count(footprint) <= (is_leaf ? few_tiles_of_leaf : few_tiles_of_bvh_node)) {
        take_away(footprint);
      } else if (falls_on_any(footprint)) {
        const Address below = bvh_node.child[child].address();
        is_leaf ? look_into_leaf(below, footprint) : look_into_bvh_node(below);
      }
    }
  }

  /// Primitives of a leaf may lie far from each other.
  void look_into_leaf(Address address, const TileFootprint& of_leaf) {
    const std::byte* const record = records_.find(address);
    for (std::size_t lane = 0; lane < read<LeafHeader>(record).count; ++lane) {
      const Box box = bounds_of(primitive_in(record, lane)).padded(pad_);
      const TileFootprint footprint = projector_.footprint_of(box);
      take_away({footprint.columns & of_leaf.columns, footprint.rows & of_leaf.rows});
    }
  }

  bool falls_on_any(const TileFootprint& footprint) const {
    for (std::uint64_t rows = footprint.rows; rows != 0; rows &= rows - 1) {
      if ((bits_[static_cast<std::size_t>(std::countr_zero(rows))] & footprint.columns) != 0) {
        return true;
      }
    }
    return false;
  }

  void take_away(const TileFootprint& footprint) {
    for (std::uint64_t rows = footprint.rows; rows != 0; rows &= rows - 1) {
      std::uint64_t& row = bits_[static_cast<std::size_t>(std::countr_zero(rows))];
      left_ -= count_of(row & footprint.columns);
      row &= ~footprint.columns;
    }
  }

  const DatabaseHeader& header_;
  LocalRecords records_;
  const BoxProjector& projector_;
  Vec3d pad_;  ///< the maximum distance of a hit from its primitive
  BackgroundTiles::Bits bits_{};
  std::uint32_t left_ = 0;  ///< number of bits
};

}  // namespace

BackgroundTiles::BackgroundTiles(const Camera& camera, const Bits& bits)
    : across_(TiledSide::of(camera.width())),
      down_(TiledSide::of(camera.height())),
      width_(static_cast<std::uint32_t>(camera.width())),
      bits_(bits) {
  for (const std::uint64_t row : bits) {
    count_ += count_of(row);
  }
}

BackgroundTiles find_background(const Database& database, const Camera& camera) {
  const BoxProjector projector(camera);
  return projector.is_certain() && !has_sky_picture(database.header())
             ? BackgroundTiles(camera, Finder(database, projector).find())
             : BackgroundTiles();
}

}  // namespace dmpc::core
