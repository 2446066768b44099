#include "apps/picture/deflate.h"

#include <zlib.h>

#include <new>

#include "core/base/expect.h"

namespace dmpc::apps {

namespace {

const Bytef* data_of(std::string_view bytes) { return reinterpret_cast<const Bytef*>(bytes.data()); }

}  // namespace

std::string deflated(std::string_view bytes, int effort) {
  uLongf size = ::compressBound(bytes.size());
  std::string packed(size, '\0');
  const int result = ::compress2(reinterpret_cast<Bytef*>(packed.data()), &size, data_of(bytes), bytes.size(), effort);
  if (result == Z_MEM_ERROR) {
    throw std::bad_alloc();
  }
  core::expect(result == Z_OK, "zlib packs what has room");
  packed.resize(size);
  return packed;
}

std::uint32_t crc_32(std::string_view bytes) { return static_cast<std::uint32_t>(::crc32_z(0, data_of(bytes), bytes.size())); }

}  // namespace dmpc::apps
