// The records that a node may ask another for, one by one, and how long they are.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/base/expect.h"
#include "core/record/instance.h"
#include "core/record/record.h"

namespace dmpc::core {

/// leaf: of the primitive that was hit, of the boxes of instances, or an InstanceRecord, which begins as a leaf does. normals:
/// a PatchNormals, TexturedNormals or FacetedNormals. tile: a TextureTile.
enum class RecordKind : std::uint8_t { leaf, normals, tile, bvh_node };

/// The most that one takes.
constexpr std::size_t bytes_max(RecordKind kind) {
  return kind == RecordKind::leaf      ? record_bytes_max
         : kind == RecordKind::normals ? sizeof(FacetedNormals)
         : kind == RecordKind::tile    ? sizeof(TextureTile)
                                       : sizeof(BvhNode);
}

/// What a PatchNormals takes with all that it begins.
inline std::size_t bytes_of_normals(const std::byte* record) {
  return !read<PatchNormals>(record).is_textured()       ? sizeof(PatchNormals)
         : read<TexturedNormals>(record).has_facets != 0 ? sizeof(FacetedNormals)
                                                         : sizeof(TexturedNormals);
}

/// What this one takes.
inline std::size_t bytes_of(RecordKind kind, const std::byte* record) {
  switch (kind) {
    case RecordKind::leaf: {
      const auto header = read<LeafHeader>(record);
      return is_instance(header) ? sizeof(InstanceRecord) : leaf_bytes(header);
    }
    case RecordKind::normals:
      return bytes_of_normals(record);
    case RecordKind::tile:
      return sizeof(TextureTile);
    case RecordKind::bvh_node:
      return sizeof(BvhNode);
  }
  expect(false, "a record that is asked for is of a known kind");
  return 0;
}

}  // namespace dmpc::core
