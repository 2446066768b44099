// Compresses bytes as zlib streams, as in EXR and PNG.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

struct libdeflate_compressor;

namespace dmpc::apps {

/// Compresses streams (RFC 1950), each in one call. Equal bytes give equal streams. Not thread-safe.
class Deflater {
 public:
  /// `level` ranges from 1, which is fast, to 12. Takes up to a mebibyte of memory. Throws std::bad_alloc.
  explicit Deflater(int level);

  /// Returns an upper bound for the packed size of `byte_count` bytes.
  std::size_t packed_bytes_max(std::size_t byte_count) const;
  /// Compresses `bytes` into `room`, and returns the size; 0 if `room` is too small, with some bytes to spare.
  std::size_t pack(std::span<const std::uint8_t> bytes, std::span<std::uint8_t> room) noexcept;

 private:
  struct Free {
    void operator()(libdeflate_compressor* compressor) const noexcept;
  };

  std::unique_ptr<libdeflate_compressor, Free> compressor_;
};

}  // namespace dmpc::apps
