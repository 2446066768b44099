// Where a node's program gets the data that it keeps during the run: bytes in memory, or from another rank.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "core/base/expect.h"

namespace dmpc::nodes {

/// Bytes that are read once, in order.
class ByteStream {
 public:
  virtual ~ByteStream() = default;
  /// Waits for as many bytes as `into` holds.
  virtual void read(std::span<std::byte> into) = 0;
};

/// Reads a count of bytes, then these bytes.
inline std::string read_counted(ByteStream& stream) {
  std::uint64_t bytes = 0;
  stream.read(std::as_writable_bytes(std::span(&bytes, 1)));
  std::string text(bytes, '\0');
  stream.read(std::as_writable_bytes(std::span(text)));
  return text;
}

/// Precedes a piece of a whole in a stream.
struct PieceHeader {
  std::uint64_t offset_bytes = 0, bytes = 0;

  bool operator==(const PieceHeader&) const = default;
};

/// A whole that is read in pieces. From a stream only the pieces come, each with its header, in the order in which they are read,
/// which the sender knows. A value; what it refers to outlives it.
class ByteSource {
 public:
  /// The whole is in memory, and lasts.
  ByteSource(std::span<const std::byte> whole) : whole_(whole), size_bytes_(whole.size()) {}
  ByteSource(ByteStream& stream, std::size_t size_bytes) : stream_(&stream), size_bytes_(size_bytes) {}

  /// The bytes of the whole.
  std::size_t size_bytes() const { return size_bytes_; }
  /// Copies the piece from `offset_bytes` on.
  void copy(std::size_t offset_bytes, std::span<std::byte> into) const {
    if (stream_ == nullptr) {
      const std::span<const std::byte> piece = whole_.subspan(offset_bytes, into.size());
      std::copy(piece.begin(), piece.end(), into.begin());  // also for 0 bytes, which memcpy() does not accept
      return;
    }
    PieceHeader header;
    stream_->read(std::as_writable_bytes(std::span(&header, 1)));
    core::expect(header == PieceHeader{offset_bytes, into.size()}, "pieces come in the order in which they are asked for");
    stream_->read(into);
  }
  /// The address of a piece that never changes. Not for a stream.
  std::span<const std::byte> immutable(std::size_t offset_bytes, std::size_t bytes) const {
    core::expect(stream_ == nullptr, "nothing lasts of a stream");
    return whole_.subspan(offset_bytes, bytes);
  }

 private:
  std::span<const std::byte> whole_;
  ByteStream* stream_ = nullptr;
  std::size_t size_bytes_;
};

}  // namespace dmpc::nodes
