// Memory of a node for pieces of bytes that never change and outlive the run.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>

#include "core/base/expect.h"
#include "core/base/filling.h"
#include "nodes/byte_source.h"
#include "nodes/layout.h"
#include "nodes/local_memory.h"

namespace dmpc::nodes {

/// Pieces of equal size, by number. If the memory refers to them (ComputerRequest::immutable()), as on a modelled machine, where
/// all nodes share the real computer's caches and memory, the memory is counted, but instead of copies there is a table, outside
/// of the node's memory, of each piece's address. Not thread-safe; belongs to one node.
class ImmutablePieces {
 public:
  /// Takes `room_bytes`: for all pieces, and what must be readable behind the last one. As much is readable behind each source
  /// piece, too.
  ImmutablePieces(LocalMemory& memory, Category category, std::size_t room_bytes, std::size_t piece_bytes)
      : piece_bytes_(piece_bytes) {
    core::expect(piece_bytes > 0, "a piece has a byte");
    if (memory.immutable() == Immutable::is_referred_to) {
      memory.count_immutable(category, room_bytes);
      places_ = std::make_unique<const std::byte*[]>(room_bytes / piece_bytes);
    } else {
      room_ = memory.allocate<std::byte>(category, room_bytes);
    }
  }
  /// The memory that the constructor takes.
  static MemoryPlan layout(Category category, std::size_t room_bytes) {
    MemoryPlan plan = Room<std::byte>{category, room_bytes};
    plan.immutable_bytes = plan[category];
    return plan;
  }

  /// To be called before all pieces are put.
  void begin_filling() { core::begin_filling(room_); }
  /// Sets the piece at `index`.
  void put(std::size_t index, std::span<const std::byte> piece) {
    core::expect(piece.size() == piece_bytes_, "pieces are of one size");
    if (places_) {
      places_[index] = piece.data();
    } else {
      std::copy(piece.begin(), piece.end(), room_.begin() + static_cast<std::ptrdiff_t>(index * piece_bytes_));
    }
  }
  /// Sets the piece at `index` to that of `source` from `offset_bytes` on.
  void put(std::size_t index, const ByteSource& source, std::size_t offset_bytes) {
    if (places_) {
      places_[index] = source.immutable(offset_bytes, piece_bytes_).data();
    } else {
      source.copy(offset_bytes, room_.subspan(index * piece_bytes_, piece_bytes_));
    }
  }
  /// The first byte of the piece that was put last at `index`.
  const std::byte* at(std::size_t index) const { return places_ ? places_[index] : room_.data() + index * piece_bytes_; }

 private:
  std::span<std::byte> room_;
  std::size_t piece_bytes_;
  std::unique_ptr<const std::byte*[]> places_;  ///< if they are referred to
};

/// One piece, the first `bytes` of `source`: its final address, with `overread_bytes` readable behind it.
inline std::span<const std::byte> kept(LocalMemory& memory, Category category, const ByteSource& source, std::size_t bytes,
                                       std::size_t overread_bytes = 0) {
  ImmutablePieces room(memory, category, bytes + overread_bytes, bytes);
  room.begin_filling();
  room.put(0, source, 0);
  return {room.at(0), bytes};
}
inline std::span<const std::byte> kept(LocalMemory& memory, Category category, std::span<const std::byte> bytes,
                                       std::size_t overread_bytes = 0) {
  return kept(memory, category, ByteSource(bytes), bytes.size(), overread_bytes);
}

}  // namespace dmpc::nodes
