// The BVH nodes and leaves of one macro cell before they have addresses.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/database/database.h"
#include "core/database/record_writer.h"
#include "core/database/tree/leaf_writer.h"
#include "core/record/record.h"

namespace dmpc::core {

/// A BVH node, the leaves and the BVH nodes below it.
struct BvhNodeDraft {
  /// Primitives of one kind, and of one plane if they need it: `count` of BvhTree::ids.
  struct Leaf {
    std::uint32_t first = 0;
    std::uint8_t count = 0;  ///< 0: the child is a BVH node
    PrimitiveKind kind{};
    std::uint32_t plane = 0;  ///< PrimitiveValues::plane() of all of them, if they need it

    LeafShape shape() const { return {count, kind, plane}; }
    std::size_t bytes() const { return shape().bytes(); }
  };
  BvhNode bvh_node;              ///< without the addresses of its children
  Address address = no_address;  ///< for a node that is of the forest or open, once it is allocated
  std::array<Leaf, bvh_children_max> leaves{};
  std::vector<BvhNodeDraft> bvh_nodes;  ///< in the order of the children
};

/// The tree that BvhBuilder makes of a macro cell. Thread safety: several may write at the same time.
struct BvhTree {
  BvhNodeDraft top;
  std::vector<std::uint32_t> ids;  ///< by leaf, ascending in each
  Address address = no_address;    ///< the first BVH node's, once it is allocated
  bool lies_in_subtrees = false;   ///< take_forest_room() has been called

  /// Adds its BVH nodes and leaves.
  void count(RecordCounts& records) const;
  /// Allocates the records: a BVH node, its leaves, and then its BVH nodes. Returns the first BVH node's address.
  Address take_room(RecordWriter& writer);
  /// Allocates in two steps, for a tree in pages of `page_size` bytes: first the BVH nodes that do not fit into a page together
  /// with everything below them, and the leaves beside them; take_room() then puts each subtree, from a BVH node or a leaf down,
  /// into one page.
  void take_forest_room(RecordWriter& writer, std::size_t page_size);
  /// Allocates, between the two, the other BVH nodes that have instances below them, and their leaves, since the meshes
  /// themselves lie elsewhere: the open part of a subtree, in one page. Does nothing if there are no instances.
  void take_open_room(RecordWriter& writer);
  /// Writes the records, which have been allocated and made writable. `told`: as in LeafWriter.
  void write(std::span<const PrimitiveValues> primitives, std::span<const ShadingReference> shading,
             std::span<const PrimitivePlane> planes, RecordWriter& writer, std::span<const std::uint32_t> reported = {}) const;
};

}  // namespace dmpc::core
