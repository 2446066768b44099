// Writes the records of primitives.
#pragma once

#include <cstdint>
#include <span>

#include "core/database/database.h"
#include "core/database/record_writer.h"
#include "core/record/record.h"

namespace dmpc::core {

/// Which primitives make a block: of one kind, and of one plane if they need theirs.
struct BlockShape {
  std::uint8_t count = 0;
  PrimitiveKind kind{};
  std::uint32_t plane = 0;  ///< PrimitiveValues::plane() of all of them, if they need it

  std::size_t bytes() const {
    return block_bytes({.kind = kind, .count = count, .plane = plane != 0 ? BlockHeader::shared_plane : std::uint8_t{0}});
  }
};

/// What it is made from outlives it. Thread safety: several may write at the same time, where room has been made.
class BlockWriter {
 public:
  /// `told`: the ids that records tell of primitives, by index, if it is not the index itself.
  BlockWriter(std::span<const PrimitiveValues> primitives, std::span<const ShadingReference> shading,
              std::span<const KeptPlane> planes, RecordWriter& writer, std::span<const std::uint32_t> told = {})
      : primitives_(primitives), shading_(shading), planes_(planes), writer_(writer), told_(told) {}

  /// Writes the block of primitives `ids`, `shape.count` of them, ascending, at `address`.
  void write(const BlockShape& shape, std::span<const std::uint32_t> ids, Address address) const;

 private:
  std::span<const PrimitiveValues> primitives_;
  std::span<const ShadingReference> shading_;
  std::span<const KeptPlane> planes_;
  RecordWriter& writer_;
  std::span<const std::uint32_t> told_;
};

}  // namespace dmpc::core
