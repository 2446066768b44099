#include "core/database/brick_tree.h"

#include <array>
#include <cstddef>
#include <cstring>

#include "core/base/units.h"

namespace dmpc::core {
namespace {

/// What a subtree takes of a page, if it begins it.
std::size_t subtree_bytes(const BrickDraft& draft) {
  std::size_t bytes = round_up(sizeof(Brick), record_alignment);
  for (const BrickDraft::Block& block : draft.blocks) {
    bytes += block.count > 0 ? round_up(block.bytes(), record_alignment) : 0;
  }
  for (const BrickDraft& brick : draft.bricks) {
    bytes += subtree_bytes(brick);
  }
  return bytes;
}

/// Takes room for the children of a brick that are blocks.
void take_block_room(BrickDraft& draft, RecordWriter& writer) {
  for (std::size_t i = 0; i < draft.brick.child_count; ++i) {
    if (const BrickDraft::Block& block = draft.blocks[i]; block.count > 0) {
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

/// Takes room for what is below bricks of the forest.
Address take_subtree_room_for(BrickDraft& draft, RecordWriter& writer) {
  if (draft.address == no_address) {
    writer.keep_together(subtree_bytes(draft));
    return take_room_for(draft, writer);
  }
  if (!has_blocks_in_forest(draft)) {
    take_block_room(draft, writer);
  }
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
    records.blocks[static_cast<std::size_t>(draft.blocks[i].kind)] += draft.blocks[i].count > 0 ? 1 : 0;
  }
  for (const BrickDraft& brick : draft.bricks) {
    count_below(brick, records);
  }
}

class TreeWriter {
 public:
  TreeWriter(const BrickTree& tree, std::span<const PrimitiveValues> primitives, std::span<const ShadingReference> shading,
             std::span<const KeptPlane> planes, RecordWriter& writer)
      : tree_(tree), primitives_(primitives), shading_(shading), planes_(planes), writer_(writer) {}

  void write(const BrickDraft& draft, Address address) const {
    writer_.write(address, 0, draft.brick);
    auto next = draft.bricks.begin();
    for (std::size_t i = 0; i < draft.brick.child_count; ++i) {
      if (draft.blocks[i].count > 0) {
        write_block(draft.blocks[i], draft.brick.child[i].address());
      } else {
        write(*next++, draft.brick.child[i].address());
      }
    }
  }

 private:
  void write_block(const BrickDraft::Block& block, Address address) const {
    std::array<std::byte, record_bytes_max> record;
    BlockHeader header{.kind = block.kind, .count = block.count};
    header.plane = block.plane != 0 ? planes_[block.plane - 1].kept_as : std::uint8_t{0};
    const std::size_t rows = value_count(block.kind);
    for (std::size_t lane = 0; lane < block.count; ++lane) {
      const std::uint32_t id = tree_.ids[block.first + lane];
      header.shared_lanes |= static_cast<std::uint8_t>(primitives_[id].plane() != 0 ? 1U << lane : 0U);
      const auto put = [&](std::size_t row, const auto& value) {
        static_assert(sizeof(value) == 4);
        std::memcpy(record.data() + sizeof(header) + 4 * (row * block.count + lane), &value, sizeof(value));
      };
      for (std::size_t row = 0; row < rows; ++row) {
        put(row, primitives_[id].value[row]);
      }
      put(rows, id);
      put(rows + 1, shading_[id]);
    }
    std::memcpy(record.data(), &header, sizeof(header));
    if (header.has_plane()) {
      const FacePlane& plane = planes_[block.plane - 1];
      std::memcpy(record.data() + block_bytes(block.kind, block.count), &plane, sizeof(FacePlane));
    }
    writer_.write(address, 0, std::as_bytes(std::span(record)).first(block.bytes()));
  }

  const BrickTree& tree_;
  std::span<const PrimitiveValues> primitives_;
  std::span<const ShadingReference> shading_;
  std::span<const KeptPlane> planes_;
  RecordWriter& writer_;
};

}  // namespace

void BrickTree::count(RecordCounts& records) const { count_below(top, records); }

Address BrickTree::take_room(RecordWriter& writer) {
  return address = lies_in_subtrees ? take_subtree_room_for(top, writer) : take_room_for(top, writer);
}

void BrickTree::take_forest_room(RecordWriter& writer, std::size_t page_size) {
  lies_in_subtrees = true;
  take_forest_room_for(top, writer, page_size);
}

void BrickTree::write(std::span<const PrimitiveValues> primitives, std::span<const ShadingReference> shading,
                      std::span<const KeptPlane> planes, RecordWriter& writer) const {
  TreeWriter(*this, primitives, shading, planes, writer).write(top, address);
}

}  // namespace dmpc::core
