#include "core/database/mesh_needs.h"

#include <array>
#include <cstdint>

#include "core/base/expect.h"
#include "core/database/region_records.h"
#include "core/record/directory.h"

namespace dmpc::core {

bool MeshNeeds::add(const Region& region) {
  expect(header_.directory_size == std::array<std::int32_t, 3>{1, 1, 1}, "meshes are kept below one top cell");
  const auto entry = read<DirectoryEntry>(at(header_.directory));
  return !entry.empty() && add_below(brick_at(entry.brick()), region);
}

/// Of the tree that has the boxes of places.
bool MeshNeeds::add_below(const Brick& brick, const Region& region) {
  bool has_any = false;
  for (std::size_t child = 0; child < brick.child_count; ++child) {
    if (touches_region(header_.frame, box_of(brick, child), region)) {
      const Address address = brick.child[child].address();
      const bool has = brick.child[child].is_block() ? add_places(at(address), region) : add_below(brick_at(address), region);
      has_any = has_any || has;
    }
  }
  return has_any;
}

bool MeshNeeds::add_places(const std::byte* block, const Region& region) {
  const auto header = read<BlockHeader>(block);
  bool has_any = false;
  for (std::size_t lane = 0; header.kind == PrimitiveKind::instance && lane < header.count; ++lane) {
    const Box box = instance_box(block, lane);
    if (!touches_region(header_.frame, box, region)) {
      continue;
    }
    const auto instance = read<InstanceRecord>(at(instance_in(block, lane)));
    const bool is_within = lies_in_region(header_.frame, box, region);
    if (is_within) {
      add_whole(instance.root);
    }
    if (is_within || add_part(instance.root, PlacedBoxes(instance, header_.frame), region)) {
      places_.insert(static_cast<std::uint32_t>(instance_in(block, lane)));
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
  const Brick& brick = brick_at(address);
  mark = {(1U << brick.child_count) - 1, true};
  for (std::size_t child = 0; child < brick.child_count; ++child) {
    if (!brick.child[child].is_block()) {
      add_whole(brick.child[child].address());
    }
  }
}

/// Says whether some block below has a box that touches the region; where all is needed anyway, that one may.
bool MeshNeeds::add_part(Address address, const PlacedBoxes& boxes, const Region& region) {
  if (mark_of(address).is_whole) {
    return true;
  }
  const Brick& brick = brick_at(address);
  std::uint32_t needed = 0;
  for (std::size_t child = 0; child < brick.child_count; ++child) {
    const Box box = boxes.box_of(brick, child);
    const BrickChild link = brick.child[child];
    if (!touches_region(header_.frame, box, region)) {
      continue;
    }
    bool is_needed = true;
    if (!link.is_block()) {
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
