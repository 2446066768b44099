#include "apps/picture/deflater.h"

#include <libdeflate.h>

#include <new>

namespace dmpc::apps {

Deflater::Deflater(int level) : compressor_(::libdeflate_alloc_compressor(level)) {
  if (compressor_ == nullptr) {
    throw std::bad_alloc();
  }
}

void Deflater::Free::operator()(libdeflate_compressor* compressor) const noexcept { ::libdeflate_free_compressor(compressor); }

std::size_t Deflater::packed_bytes_max(std::size_t byte_count) const {
  return ::libdeflate_zlib_compress_bound(compressor_.get(), byte_count);
}

std::size_t Deflater::pack(std::span<const std::uint8_t> bytes, std::span<std::uint8_t> room) noexcept {
  return ::libdeflate_zlib_compress(compressor_.get(), bytes.data(), bytes.size(), room.data(), room.size());
}

}  // namespace dmpc::apps
