#include "core/database/brick_tree.h"

#include <algorithm>
#include <cstddef>

#include "core/base/units.h"

namespace dmpc::core {
namespace {

bool is_of_instances(const BrickDraft::Block& block) { return block.count > 0 && block.kind == PrimitiveKind::instance; }

/// Whether the walk below the brick may lead into meshes.
bool is_open(const BrickDraft& draft) {
  return std::any_of(draft.blocks.begin(), draft.blocks.end(), is_of_instances) ||
         std::any_of(draft.bricks.begin(), draft.bricks.end(), is_open);
}

/// What a subtree takes of a page, if it begins it: all of it, or what is open.
std::size_t subtree_bytes(const BrickDraft& draft, bool of_open_alone = false) {
  std::size_t bytes = round_up(sizeof(Brick), record_alignment);
  for (const BrickDraft::Block& block : draft.blocks) {
    const bool counts = block.count > 0 && (!of_open_alone || is_of_instances(block));
    bytes += counts ? round_up(block.bytes(), record_alignment) : 0;
  }
  for (const BrickDraft& brick : draft.bricks) {
    bytes += !of_open_alone || is_open(brick) ? subtree_bytes(brick, of_open_alone) : 0;
  }
  return bytes;
}

/// Takes room for the children of a brick that are blocks and have none: for all, or for those of instances.
void take_block_room(BrickDraft& draft, RecordWriter& writer, bool of_instances_alone = false) {
  for (std::size_t i = 0; i < draft.brick.child_count; ++i) {
    const BrickDraft::Block& block = draft.blocks[i];
    if (block.count > 0 && !draft.brick.child[i].is_block() && (!of_instances_alone || is_of_instances(block))) {
      draft.brick.child[i] = BrickChild::block(writer.allocate(block.bytes()));
    }
  }
}

/// Blocks beside bricks are of what is large, which many rays meet: they belong to the forest, lest one page be asked about by
/// all.
bool has_blocks_in_forest(const BrickDraft& draft) { return !draft.bricks.empty(); }

/// Takes room for the brick if no page holds what is below it, too, and so on down; returns whether.
bool take_forest_room_for(BrickDraft& draft, RecordWriter& writer, std::size_t page_size) {
  if (subtree_bytes(draft) <= page_size) {
    return false;
  }
  draft.address = writer.allocate(sizeof(Brick));
  if (has_blocks_in_forest(draft)) {
    take_block_room(draft, writer);
  }
  for (BrickDraft& brick : draft.bricks) {
    take_forest_room_for(brick, writer, page_size);
  }
  return true;
}

Address take_room_for(BrickDraft& draft, RecordWriter& writer) {
  const Address address = writer.allocate(sizeof(Brick));
  take_block_room(draft, writer);
  auto next = draft.bricks.begin();
  for (std::size_t i = 0; i < draft.brick.child_count; ++i) {
    if (draft.blocks[i].count == 0) {
      draft.brick.child[i] = BrickChild::brick(take_room_for(*next++, writer));
    }
  }
  return address;
}

/// Takes room for an open brick, its blocks of instances, and then its open bricks.
void take_open_records(BrickDraft& draft, RecordWriter& writer) {
  constexpr bool of_instances_alone = true;
  draft.address = writer.allocate(sizeof(Brick));
  take_block_room(draft, writer, of_instances_alone);
  for (BrickDraft& brick : draft.bricks) {
    if (is_open(brick)) {
      take_open_records(brick, writer);
    }
  }
}

/// Takes room for what is open below bricks of the forest.
void take_open_room_for(BrickDraft& draft, RecordWriter& writer) {
  constexpr bool of_instances_alone = true;
  if (!is_open(draft)) {
    return;
  }
  if (draft.address == no_address) {
    writer.keep_together(subtree_bytes(draft, of_instances_alone));
    return take_open_records(draft, writer);
  }
  take_block_room(draft, writer, of_instances_alone);
  for (BrickDraft& brick : draft.bricks) {
    take_open_room_for(brick, writer);
  }
}

/// Takes room for what is below bricks that have room.
Address take_subtree_room_for(BrickDraft& draft, RecordWriter& writer) {
  if (draft.address == no_address) {
    writer.keep_together(subtree_bytes(draft));
    return take_room_for(draft, writer);
  }
  take_block_room(draft, writer);
  auto next = draft.bricks.begin();
  for (std::size_t i = 0; i < draft.brick.child_count; ++i) {
    if (draft.blocks[i].count == 0) {
      draft.brick.child[i] = BrickChild::brick(take_subtree_room_for(*next++, writer));
    }
  }
  return draft.address;
}

void count_below(const BrickDraft& draft, RecordCounts& records) {
  ++records.bricks;
  for (std::size_t i = 0; i < draft.brick.child_count; ++i) {
    auto& count = draft.blocks[i].kind == PrimitiveKind::instance
                      ? records.instance_blocks
                      : records.blocks[static_cast<std::size_t>(draft.blocks[i].kind)];
    count += draft.blocks[i].count > 0 ? 1 : 0;
  }
  for (const BrickDraft& brick : draft.bricks) {
    count_below(brick, records);
  }
}

void write_below(const BrickDraft& draft, Address address, const BlockWriter& blocks, std::span<const std::uint32_t> ids,
                 RecordWriter& writer) {
  writer.write(address, 0, draft.brick);
  auto next = draft.bricks.begin();
  for (std::size_t i = 0; i < draft.brick.child_count; ++i) {
    if (const BrickDraft::Block& block = draft.blocks[i]; block.count > 0) {
      blocks.write(block.shape(), ids.subspan(block.first, block.count), draft.brick.child[i].address());
    } else {
      write_below(*next++, draft.brick.child[i].address(), blocks, ids, writer);
    }
  }
}

}  // namespace

void BrickTree::count(RecordCounts& records) const { count_below(top, records); }

Address BrickTree::take_room(RecordWriter& writer) {
  return address = lies_in_subtrees ? take_subtree_room_for(top, writer) : take_room_for(top, writer);
}

void BrickTree::take_forest_room(RecordWriter& writer, std::size_t page_size) {
  lies_in_subtrees = true;
  take_forest_room_for(top, writer, page_size);
}

void BrickTree::take_open_room(RecordWriter& writer) { take_open_room_for(top, writer); }

void BrickTree::write(std::span<const PrimitiveValues> primitives, std::span<const ShadingReference> shading,
                      std::span<const KeptPlane> planes, RecordWriter& writer, std::span<const std::uint32_t> told) const {
  write_below(top, address, BlockWriter(primitives, shading, planes, writer, told), ids, writer);
}

}  // namespace dmpc::core
