// Room in a node's memory for pieces of bytes that never change and outlive the run, such as parts of the scene.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "core/base/expect.h"
#include "nodes/local_memory.h"

namespace dmpc::nodes {

/// Pieces of equal size, by number. On a modelled machine, where all nodes share the real computer's caches,
/// the room is there and counted, but has in it where each piece is, in place of a copy. Thread safety: none; belongs to one
/// node.
class LastingPieces {
 public:
  /// Takes `room_bytes`: those of all pieces, and what must be readable behind the last one. It is so behind each that is put
  /// there, too.
  LastingPieces(LocalMemory& memory, Category category, std::size_t room_bytes, std::size_t piece_bytes)
      : room_(memory.allocate<std::byte>(category, room_bytes)),
        piece_bytes_(piece_bytes),
        is_referring_(memory.lasting() == Lasting::is_referred_to) {
    core::expect(piece_bytes >= sizeof(const std::byte*), "a piece has room for its place");
  }

  /// `piece` is now at `index`, in place of what was there.
  void put(std::size_t index, std::span<const std::byte> piece) {
    core::expect(piece.size() == piece_bytes_, "pieces are of one size");
    if (is_referring_) {
      places()[index] = piece.data();
    } else {
      std::copy(piece.begin(), piece.end(), room_.begin() + static_cast<std::ptrdiff_t>(index * piece_bytes_));
    }
  }
  /// The first byte of the piece that was put there last.
  const std::byte* at(std::size_t index) const { return is_referring_ ? places()[index] : room_.data() + index * piece_bytes_; }

 private:
  const std::byte** places() const { return reinterpret_cast<const std::byte**>(room_.data()); }

  std::span<std::byte> room_;
  std::size_t piece_bytes_;
  bool is_referring_;
};

/// One piece: where its bytes are from now on, and `overread_bytes` that are readable behind them.
inline std::span<const std::byte> kept(LocalMemory& memory, Category category, std::span<const std::byte> bytes,
                                       std::size_t overread_bytes = 0) {
  LastingPieces room(memory, category, bytes.size() + overread_bytes, bytes.size());
  room.put(0, bytes);
  return {room.at(0), bytes.size()};
}

}  // namespace dmpc::nodes
