// What to tell the operating system of bytes that are about to be filled.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/large_pages.h"

namespace dmpc::core {

/// All of these bytes, and maybe none beside them, are about to be written: asks for the large pages that lie wholly in them, so
/// that not each small one is an interruption. Thread-safe.
inline void begin_filling(std::span<std::byte> bytes) noexcept {
  const auto begin = reinterpret_cast<std::uintptr_t>(bytes.data());
  const std::size_t before = (large_page_bytes - begin % large_page_bytes) % large_page_bytes;
  if (bytes.size() >= before + large_page_bytes) {
    wish_large_pages(bytes.data() + before, (bytes.size() - before) / large_page_bytes * large_page_bytes);
  }
}

}  // namespace dmpc::core
