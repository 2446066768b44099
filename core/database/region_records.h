// The records that a region of space needs, found from the directory downwards, as by a ray.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "core/base/box.h"
#include "core/base/region.h"
#include "core/database/meshes/placed_boxes.h"
#include "core/database/shading/texture_records.h"
#include "core/record/directory.h"
#include "core/record/record.h"
#include "core/record/records.h"
#include "core/record/texture_layout.h"

namespace dmpc::core {

/// Whether a box, grid-local, borders included, touches a region: a ray in a region never needs the contents of a box that does
/// not touch it.
inline bool touches_region(const GridFrame& frame, const Box& box, const Region& region) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (box.low[axis] > plane_at(frame, axis, region.high[axis]) || box.high[axis] < plane_at(frame, axis, region.low[axis])) {
      return false;
    }
  }
  return true;
}
/// Whether the box lies in the region, borders included.
inline bool lies_in_region(const GridFrame& frame, const Box& box, const Region& region) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (box.low[axis] < plane_at(frame, axis, region.low[axis]) || box.high[axis] > plane_at(frame, axis, region.high[axis])) {
      return false;
    }
  }
  return true;
}

/// Calls visit(address) for the records of a whole database that rays in `region`, and shading the hits there, may need, except
/// for materials and lights; for some more than once, though only few base meshes are repeated for each instance. Takes no memory
/// except a stack as deep as the trees. Requires that all records are present: `records` never returns nullptr.
template <Records R, class Visit>
class RegionRecords {
 public:
  RegionRecords(R& records, const DatabaseHeader& header, const Region& region, const Visit& visit)
      : records_(&records), header_(&header), region_(&region), visit_(&visit) {
    seen_.fill(no_address);
  }

  void visit_all() {
    Corner first;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      first[axis] = region_->low[axis] / finest_per_macro * finest_per_macro;
    }
    for_each_macro_cell(first, region_->high, false, [this](const Corner& cell) { visit_macro_cell(cell); });
  }

 private:
  /// The record at an address, to be copied from at once.
  const std::byte* at(Address address) {
    (*visit_)(address);
    return records_->find(address);
  }

  void visit_macro_cell(const Corner& cell) {
    const DirectoryEntry entry = entry_of(*header_, cell, [this](Address address) { return at(address); });
    if (!entry.empty()) {
      header_->has_voxels() ? visit_list(entry) : visit_bvh_node(entry.bvh_node());
    }
  }

  /// Everything in the voxel's list, since a record does not say how far beside it a hit may lie.
  void visit_list(const DirectoryEntry& entry) {
    for (std::uint64_t index = entry.bits;; ++index) {
      const auto reference = read<VoxelReference>(at(reference_address(*header_, index)) + reference_offset(index));
      visit_leaf(reference.leaf());
      if (reference.is_last()) {
        return;
      }
    }
  }

  void visit_bvh_node(Address address) {
    const auto bvh_node = read<BvhNode>(at(address));
    for (std::size_t child = 0; child < bvh_node.child_count; ++child) {
      if (touches_region(header_->frame, box_of(bvh_node, child), *region_)) {
        bvh_node.child[child].is_leaf() ? visit_leaf(bvh_node.child[child].address())
                                        : visit_bvh_node(bvh_node.child[child].address());
      }
    }
  }

  void visit_leaf(Address address) {
    const std::byte* const leaf = at(address);
    const auto header = read<LeafHeader>(leaf);
    if (header.kind == PrimitiveKind::instance) {
      std::array<std::byte, record_bytes_max> places;
      std::memcpy(places.data(), leaf, leaf_bytes(header));
      return visit_places(places.data(), header.count);
    }
    std::array<ShadingReference, leaf_lanes> lanes;
    const std::size_t row = sizeof(ShadingReference) * header.count;
    std::memcpy(lanes.data(), leaf + leaf_bytes(header.kind, header.count) - row, row);
    for (std::size_t lane = 0; lane < header.count; ++lane) {
      if (lanes[lane].is_smooth()) {
        visit_normals(lanes[lane].normals());
      }
    }
  }

  void visit_places(const std::byte* leaf, std::size_t count) {
    for (std::size_t lane = 0; lane < count; ++lane) {
      const Box box = instance_box(leaf, lane);
      if (touches_region(header_->frame, box, *region_)) {
        const auto instance = read<InstanceRecord>(at(instance_in(leaf, lane)));
        if (!lies_in_region(header_->frame, box, *region_)) {
          const PlacedBoxes boxes(instance, header_->frame);
          visit_mesh(instance.root, &boxes);
        } else if (Address& seen = seen_of(instance.root); seen != instance.root) {
          visit_mesh(instance.root, nullptr);
          seen = instance.root;
        }
      }
    }
  }

  /// What an instance of a base mesh needs in the region; without boxes all of the mesh.
  void visit_mesh(Address address, const PlacedBoxes* boxes) {
    const auto bvh_node = read<BvhNode>(at(address));
    for (std::size_t child = 0; child < bvh_node.child_count; ++child) {
      if (boxes == nullptr || touches_region(header_->frame, boxes->box_of(bvh_node, child), *region_)) {
        bvh_node.child[child].is_leaf() ? visit_leaf(bvh_node.child[child].address())
                                        : visit_mesh(bvh_node.child[child].address(), boxes);
      }
    }
  }

  /// The mesh that was visited last, by entry; several meshes may share one.
  Address& seen_of(Address mesh) { return seen_[static_cast<std::uint32_t>(mesh) * 0x9e3779b1U >> 26U]; }

  void visit_normals(Address address) {
    const std::byte* const normals = at(address);
    if (read<PatchNormals>(normals).is_textured()) {
      const auto textured = read<TexturedNormals>(normals);
      if (!textured.has_texture()) {
        return;
      }
      visit_tiles(textured, textured.texture);
      if (textured.has_facets != 0) {
        visit_tiles(textured, read<FacetedNormals>(normals).facets);
      }
    }
  }

  void visit_tiles(const TexturedNormals& triangle, const TextureReference& texture) {
    for_each_tile(triangle, texture, [&](std::uint32_t tile) {
      const Address entry = tile_entry_address(texture, tile);
      (*visit_)(read<Address>(at(entry) + tile_entry_offset(tile)));
    });
  }

  R* records_;
  const DatabaseHeader* header_;
  const Region* region_;
  const Visit* visit_;
  std::array<Address, 64> seen_;  ///< the first BVH nodes of meshes that have been visited completely
};

template <Records R, class Visit>
void for_each_record_of(R& records, const DatabaseHeader& header, const Region& region, const Visit& visit) {
  RegionRecords<R, Visit>(records, header, region, visit).visit_all();
}

}  // namespace dmpc::core
