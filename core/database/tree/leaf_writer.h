// Writes leaves.
#pragma once

#include <cstdint>
#include <span>

#include "core/database/database.h"
#include "core/database/record_writer.h"
#include "core/record/record.h"

namespace dmpc::core {

/// The primitives of a leaf: of one kind, and of one plane if they need it.
struct LeafShape {
  std::uint8_t count = 0;
  PrimitiveKind kind{};
  std::uint32_t plane = 0;  ///< PrimitiveValues::plane() of all of them, if they need it

  std::size_t bytes() const {
    return leaf_bytes({.kind = kind, .count = count, .plane = plane != 0 ? LeafHeader::shared_plane : std::uint8_t{0}});
  }
};

/// The constructor's arguments outlive it. Thread safety: several may write at the same time, where memory has been made
/// writable.
class LeafWriter {
 public:
  /// `told`: the ids that records store for primitives, by index, if it is not the index itself.
  LeafWriter(std::span<const PrimitiveValues> primitives, std::span<const ShadingReference> shading,
             std::span<const PrimitivePlane> planes, RecordWriter& writer, std::span<const std::uint32_t> reported = {})
      : primitives_(primitives), shading_(shading), planes_(planes), writer_(writer), reported_(reported) {}

  /// Writes the leaf of primitives `ids`, `shape.count` of them, ascending, at `address`.
  void write(const LeafShape& shape, std::span<const std::uint32_t> ids, Address address) const;

 private:
  std::span<const PrimitiveValues> primitives_;
  std::span<const ShadingReference> shading_;
  std::span<const PrimitivePlane> planes_;
  RecordWriter& writer_;
  std::span<const std::uint32_t> reported_;
};

}  // namespace dmpc::core
