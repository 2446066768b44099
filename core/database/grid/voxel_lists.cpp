#include "core/database/grid/voxel_lists.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "core/base/expect.h"
#include "core/record/directory.h"

namespace dmpc::core {
namespace {

std::uint32_t primitive_plane(const PrimitiveValues& primitive) { return primitive.needs_plane() ? primitive.plane() : 0; }

}  // namespace

VoxelLists::VoxelLists(const MacroCells& voxels, const Conversion& conversion, const VoxelRule& rule)
    : voxels_(voxels), rule_(rule) {
  make_leaves(conversion);
  listed_.reserve(voxels.references());
  list_ends_.reserve(voxels.size());
  for (std::size_t i = 0; i < voxels.size(); ++i) {
    const std::size_t begin = listed_.size();
    for (const std::uint32_t id : voxels.ids(i)) {
      if (listed_.size() == begin || listed_.back() != leaf_of_[id]) {
        listed_.push_back(leaf_of_[id]);
      }
    }
    list_ends_.push_back(listed_.size());
  }
  expect(listed_.size() < references_max, "an entry of the directory tells any reference");
  order_.resize(leaves_.size());
  std::iota(order_.begin(), order_.end(), 0U);
  if (rule_.follows_space) {
    sort_by_place();
  }
}

void VoxelLists::make_leaves(const Conversion& conversion) {
  leaf_of_.resize(conversion.primitives.size());
  for (std::uint32_t id = 0; id < conversion.primitives.size(); ++id) {
    const PrimitiveValues& primitive = conversion.primitives[id];
    const bool goes_on = id > 0 && primitive.kind == PrimitiveKind::triangle && leaves_.back().shape.kind == primitive.kind &&
                         conversion.sources[id].object == conversion.sources[id - 1].object &&
                         leaves_.back().shape.plane == primitive_plane(primitive) && leaves_.back().shape.count < leaf_lanes;
    if (!goes_on) {
      leaves_.push_back({{0, primitive.kind, primitive_plane(primitive)}, id});
    }
    ++leaves_.back().shape.count;
    leaf_of_[id] = static_cast<std::uint32_t>(leaves_.size() - 1);
  }
}

/// In the order in which they are first listed. Every leaf is listed.
void VoxelLists::sort_by_place() {
  std::vector<bool> is_there(leaves_.size());
  std::size_t next = 0;
  for (const std::uint32_t leaf : listed_) {
    if (!is_there[leaf]) {
      is_there[leaf] = true;
      order_[next++] = leaf;
    }
  }
  expect(next == leaves_.size(), "every primitive touches a voxel");
}

/// The bytes of a record without the normals of its triangles.
std::size_t VoxelLists::share_of(const Leaf& leaf, const Conversion& conversion) const {
  std::size_t left = rule_.record_bytes;
  for (std::uint32_t id = leaf.first; id < leaf.first + leaf.shape.count; ++id) {
    const std::size_t normals = conversion.shading[id].is_smooth() ? sizeof(PatchNormals) : 0;
    left -= std::min(left, normals);
  }
  return left;
}

void VoxelLists::take_room(const Conversion& conversion, RecordWriter& writer) {
  for (const std::uint32_t leaf : order_) {
    leaves_[leaf].address = writer.allocate(leaves_[leaf].shape.bytes(), share_of(leaves_[leaf], conversion));
  }
}

void VoxelLists::write(const Conversion& conversion, Address references, RecordWriter& writer) {
  const LeafWriter leaves(conversion.primitives, conversion.shading, conversion.planes, writer);
  std::array<std::uint32_t, leaf_lanes> ids{};
  for (const Leaf& leaf : leaves_) {
    std::iota(ids.begin(), ids.end(), leaf.first);
    leaves.write(leaf.shape, std::span(ids).first(leaf.shape.count), leaf.address);
  }
  std::vector<VoxelReference> list(listed_.size());
  for (std::size_t i = 0; i < listed_.size(); ++i) {
    list[i] = VoxelReference::to(leaves_[listed_[i]].address);
  }
  for (const std::uint64_t end : list_ends_) {
    list[end - 1].bits |= VoxelReference::last_flag;
  }
  writer.write(references, 0, std::as_bytes(std::span(list)));
}

void VoxelLists::enter(const std::array<std::int32_t, 3>& size, std::span<DirectoryEntry> directory) const {
  std::uint64_t begin = 0;
  for (std::size_t i = 0; i < voxels_.size(); ++i) {
    directory[voxel_index(size, voxels_.corner(i))].bits = static_cast<std::uint32_t>(begin);
    begin = list_ends_[i];
  }
}

void VoxelLists::count(RecordCounts& records) const {
  for (const Leaf& leaf : leaves_) {
    ++records.leaves[static_cast<std::size_t>(leaf.shape.kind)];
  }
  records.voxel_references = references();
}

}  // namespace dmpc::core
