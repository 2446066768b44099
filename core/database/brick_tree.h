// The bricks and blocks of one top cell before they have addresses.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/database/block_writer.h"
#include "core/database/database.h"
#include "core/database/record_writer.h"
#include "core/record/record.h"

namespace dmpc::core {

/// A brick, the blocks and the bricks below it.
struct BrickDraft {
  /// Primitives of one kind, and of one plane if they need theirs: `count` of BrickTree::ids.
  struct Block {
    std::uint32_t first = 0;
    std::uint8_t count = 0;  ///< 0: the child is a brick
    PrimitiveKind kind{};
    std::uint32_t plane = 0;  ///< PrimitiveValues::plane() of all of them, if they need it

    BlockShape shape() const { return {count, kind, plane}; }
    std::size_t bytes() const { return shape().bytes(); }
  };
  Brick brick;                   ///< without the addresses of its children
  Address address = no_address;  ///< of a brick that is of the forest or open, once there is room
  std::array<Block, brick_children_max> blocks{};
  std::vector<BrickDraft> bricks;  ///< in the order of the children
};

/// What BrickBuilder makes of a top cell. Thread safety: several may write at the same time.
struct BrickTree {
  BrickDraft top;
  std::vector<std::uint32_t> ids;  ///< of the blocks, ascending in each
  Address address = no_address;    ///< of the first brick, once there is room
  bool lies_in_subtrees = false;   ///< take_forest_room() has been called

  /// Adds its bricks and blocks.
  void count(RecordCounts& records) const;
  /// Takes room for the records: a brick, its blocks, and then its bricks. Returns the first brick's address.
  Address take_room(RecordWriter& writer);
  /// Takes room in two steps, for a tree that lies in pages of `page_size` bytes: first for the bricks that no page holds
  /// together with all that is below them, and the blocks beside them; take_room() then puts each subtree, from a brick or a
  /// block down, into one page.
  void take_forest_room(RecordWriter& writer, std::size_t page_size);
  /// Takes room between the two for the other bricks that have instances below them, and the blocks of these, since the meshes
  /// themselves lie elsewhere: the part of a subtree that is open, in one page. Takes none if there are no instances.
  void take_open_room(RecordWriter& writer);
  /// Writes the records, for which room has been taken and made. `told`: as BlockWriter has it.
  void write(std::span<const PrimitiveValues> primitives, std::span<const ShadingReference> shading,
             std::span<const KeptPlane> planes, RecordWriter& writer, std::span<const std::uint32_t> told = {}) const;
};

}  // namespace dmpc::core
