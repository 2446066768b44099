#include "core/database/meshes/mesh_needs.h"

#include <array>
#include <cstdint>

#include "core/base/expect.h"
#include "core/database/region_records.h"
#include "core/record/directory.h"

namespace dmpc::core {

bool MeshNeeds::add(const Region& region) {
  expect(header_.directory_size == std::array<std::int32_t, 3>{1, 1, 1}, "meshes are kept below one macro cell");
  const auto entry = read<DirectoryEntry>(at(header_.directory));
  return !entry.empty() && add_below(bvh_node_at(entry.bvh_node()), region);
}

/// For the tree over the boxes of instances.
bool MeshNeeds::add_below(const BvhNode& bvh_node, const Region& region) {
  bool has_any = false;
  for (std::size_t child = 0; child < bvh_node.child_count; ++child) {
    if (touches_region(header_.frame, box_of(bvh_node, child), region)) {
      const Address address = bvh_node.child[child].address();
      const bool has = bvh_node.child[child].is_leaf() ? add_slots(at(address), region) : add_below(bvh_node_at(address), region);
      has_any = has_any || has;
    }
  }
  return has_any;
}

bool MeshNeeds::add_slots(const std::byte* leaf, const Region& region) {
  const auto header = read<LeafHeader>(leaf);
  bool has_any = false;
  for (std::size_t lane = 0; header.kind == PrimitiveKind::instance && lane < header.count; ++lane) {
    const Box box = instance_box(leaf, lane);
    if (!touches_region(header_.frame, box, region)) {
      continue;
    }
    const auto instance = read<InstanceRecord>(at(instance_in(leaf, lane)));
    const bool is_within = lies_in_region(header_.frame, box, region);
    if (is_within) {
      add_whole(instance.root);
    }
    if (is_within || add_part(instance.root, PlacedBoxes(instance, header_.frame), region)) {
      instances_.insert(static_cast<std::uint32_t>(instance_in(leaf, lane)));
      has_any = true;
    }
  }
  return has_any;
}

void MeshNeeds::add_whole(Address address) {
  Mark& mark = mark_of(address);
  if (mark.is_whole) {
    return;
  }
  const BvhNode& bvh_node = bvh_node_at(address);
  mark = {(1U << bvh_node.child_count) - 1, true};
  for (std::size_t child = 0; child < bvh_node.child_count; ++child) {
    if (!bvh_node.child[child].is_leaf()) {
      add_whole(bvh_node.child[child].address());
    }
  }
}

/// Whether some leaf below has a box that touches the region; may also be true if everything is needed anyway.
bool MeshNeeds::add_part(Address address, const PlacedBoxes& boxes, const Region& region) {
  if (mark_of(address).is_whole) {
    return true;
  }
  const BvhNode& bvh_node = bvh_node_at(address);
  std::uint32_t needed = 0;
  for (std::size_t child = 0; child < bvh_node.child_count; ++child) {
    const Box box = boxes.box_of(bvh_node, child);
    const BvhChild link = bvh_node.child[child];
    if (!touches_region(header_.frame, box, region)) {
      continue;
    }
    bool is_needed = true;
    if (!link.is_leaf()) {
      if (lies_in_region(header_.frame, box, region)) {
        add_whole(link.address());
      } else {
        is_needed = add_part(link.address(), boxes, region);
      }
    }
    needed |= (is_needed ? 1U : 0U) << child;
  }
  if (needed != 0) {
    mark_of(address).children |= needed;
  }
  return needed != 0;
}

}  // namespace dmpc::core
