#include "core/database/tree/bvh_tree.h"

#include <algorithm>
#include <cstddef>

#include "core/base/units.h"

namespace dmpc::core {
namespace {

bool is_of_instances(const BvhNodeDraft::Leaf& leaf) { return leaf.count > 0 && leaf.kind == PrimitiveKind::instance; }

/// Whether traversal below the BVH node may enter meshes.
bool is_open(const BvhNodeDraft& draft) {
  return std::any_of(draft.leaves.begin(), draft.leaves.end(), is_of_instances) ||
         std::any_of(draft.bvh_nodes.begin(), draft.bvh_nodes.end(), is_open);
}

/// The bytes in a page of a subtree that begins it: all of the subtree, or its open part.
std::size_t subtree_bytes(const BvhNodeDraft& draft, bool of_open_alone = false) {
  std::size_t bytes = round_up(sizeof(BvhNode), record_alignment);
  for (const BvhNodeDraft::Leaf& leaf : draft.leaves) {
    const bool counts = leaf.count > 0 && (!of_open_alone || is_of_instances(leaf));
    bytes += counts ? round_up(leaf.bytes(), record_alignment) : 0;
  }
  for (const BvhNodeDraft& bvh_node : draft.bvh_nodes) {
    bytes += !of_open_alone || is_open(bvh_node) ? subtree_bytes(bvh_node, of_open_alone) : 0;
  }
  return bytes;
}

/// Allocates the leaf children of a BVH node that have no address: all, or only those of instances.
void take_leaf_room(BvhNodeDraft& draft, RecordWriter& writer, bool of_instances_alone = false) {
  for (std::size_t i = 0; i < draft.bvh_node.child_count; ++i) {
    const BvhNodeDraft::Leaf& leaf = draft.leaves[i];
    if (leaf.count > 0 && !draft.bvh_node.child[i].is_leaf() && (!of_instances_alone || is_of_instances(leaf))) {
      draft.bvh_node.child[i] = BvhChild::leaf(writer.allocate(leaf.bytes()));
    }
  }
}

/// Leaves beside BVH nodes hold large primitives, which many rays meet: they belong to the forest, so that not all nodes request
/// the same page.
bool has_leaves_in_forest(const BvhNodeDraft& draft) { return !draft.bvh_nodes.empty(); }

/// Allocates the BVH node, and recursively its children, if no page holds its whole subtree; returns whether it did.
bool take_forest_room_for(BvhNodeDraft& draft, RecordWriter& writer, std::size_t page_size) {
  if (subtree_bytes(draft) <= page_size) {
    return false;
  }
  draft.address = writer.allocate(sizeof(BvhNode));
  if (has_leaves_in_forest(draft)) {
    take_leaf_room(draft, writer);
  }
  for (BvhNodeDraft& bvh_node : draft.bvh_nodes) {
    take_forest_room_for(bvh_node, writer, page_size);
  }
  return true;
}

Address take_room_for(BvhNodeDraft& draft, RecordWriter& writer) {
  const Address address = writer.allocate(sizeof(BvhNode));
  take_leaf_room(draft, writer);
  auto next = draft.bvh_nodes.begin();
  for (std::size_t i = 0; i < draft.bvh_node.child_count; ++i) {
    if (draft.leaves[i].count == 0) {
      draft.bvh_node.child[i] = BvhChild::bvh_node(take_room_for(*next++, writer));
    }
  }
  return address;
}

/// Allocates an open BVH node, then its leaves of instances, then its open children.
void take_open_records(BvhNodeDraft& draft, RecordWriter& writer) {
  constexpr bool of_instances_alone = true;
  draft.address = writer.allocate(sizeof(BvhNode));
  take_leaf_room(draft, writer, of_instances_alone);
  for (BvhNodeDraft& bvh_node : draft.bvh_nodes) {
    if (is_open(bvh_node)) {
      take_open_records(bvh_node, writer);
    }
  }
}

/// Allocates the open nodes below BVH nodes of the forest.
void take_open_room_for(BvhNodeDraft& draft, RecordWriter& writer) {
  constexpr bool of_instances_alone = true;
  if (!is_open(draft)) {
    return;
  }
  if (draft.address == no_address) {
    writer.keep_together(subtree_bytes(draft, of_instances_alone));
    return take_open_records(draft, writer);
  }
  take_leaf_room(draft, writer, of_instances_alone);
  for (BvhNodeDraft& bvh_node : draft.bvh_nodes) {
    take_open_room_for(bvh_node, writer);
  }
}

/// Allocates the subtrees below allocated BVH nodes.
Address take_subtree_room_for(BvhNodeDraft& draft, RecordWriter& writer) {
  if (draft.address == no_address) {
    writer.keep_together(subtree_bytes(draft));
    return take_room_for(draft, writer);
  }
  take_leaf_room(draft, writer);
  auto next = draft.bvh_nodes.begin();
  for (std::size_t i = 0; i < draft.bvh_node.child_count; ++i) {
    if (draft.leaves[i].count == 0) {
      draft.bvh_node.child[i] = BvhChild::bvh_node(take_subtree_room_for(*next++, writer));
    }
  }
  return draft.address;
}

void count_below(const BvhNodeDraft& draft, RecordCounts& records) {
  ++records.bvh_nodes;
  for (std::size_t i = 0; i < draft.bvh_node.child_count; ++i) {
    auto& count = draft.leaves[i].kind == PrimitiveKind::instance
                      ? records.instance_leaves
                      : records.leaves[static_cast<std::size_t>(draft.leaves[i].kind)];
    count += draft.leaves[i].count > 0 ? 1 : 0;
  }
  for (const BvhNodeDraft& bvh_node : draft.bvh_nodes) {
    count_below(bvh_node, records);
  }
}

void write_below(const BvhNodeDraft& draft, Address address, const LeafWriter& leaves, std::span<const std::uint32_t> ids,
                 RecordWriter& writer) {
  writer.write(address, 0, draft.bvh_node);
  auto next = draft.bvh_nodes.begin();
  for (std::size_t i = 0; i < draft.bvh_node.child_count; ++i) {
    if (const BvhNodeDraft::Leaf& leaf = draft.leaves[i]; leaf.count > 0) {
      leaves.write(leaf.shape(), ids.subspan(leaf.first, leaf.count), draft.bvh_node.child[i].address());
    } else {
      write_below(*next++, draft.bvh_node.child[i].address(), leaves, ids, writer);
    }
  }
}

}  // namespace

void BvhTree::count(RecordCounts& records) const { count_below(top, records); }

Address BvhTree::take_room(RecordWriter& writer) {
  return address = lies_in_subtrees ? take_subtree_room_for(top, writer) : take_room_for(top, writer);
}

void BvhTree::take_forest_room(RecordWriter& writer, std::size_t page_size) {
  lies_in_subtrees = true;
  take_forest_room_for(top, writer, page_size);
}

void BvhTree::take_open_room(RecordWriter& writer) { take_open_room_for(top, writer); }

void BvhTree::write(std::span<const PrimitiveValues> primitives, std::span<const ShadingReference> shading,
                    std::span<const PrimitivePlane> planes, RecordWriter& writer, std::span<const std::uint32_t> reported) const {
  write_below(top, address, LeafWriter(primitives, shading, planes, writer, reported), ids, writer);
}

}  // namespace dmpc::core
