// Bytes packed as zlib streams, as EXR and PNG want them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

struct libdeflate_compressor;

namespace dmpc::apps {

/// Packs streams one after the other (RFC 1950), each at once. The same bytes are packed the same. Thread safety: one thread at a
/// time.
class Deflater {
 public:
  /// `level`: from 1, which is fast, to 12. Takes up to a mebibyte. Throws std::bad_alloc.
  explicit Deflater(int level);

  /// Upper bound for the packed size of `byte_count` bytes.
  std::size_t packed_bytes_max(std::size_t byte_count) const;
  /// Packs `bytes` into `room`, and returns how much of it that took; 0 if there is less than it takes and some bytes to spare.
  std::size_t pack(std::span<const std::uint8_t> bytes, std::span<std::uint8_t> room) noexcept;

 private:
  struct Free {
    void operator()(libdeflate_compressor* compressor) const noexcept;
  };

  std::unique_ptr<libdeflate_compressor, Free> compressor_;
};

}  // namespace dmpc::apps
