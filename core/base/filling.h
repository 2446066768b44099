// Pages as large as the operating system has them, asked for where many bytes are about to be filled.
#pragma once

#include <sys/mman.h>
#include <cstddef>
#include <cstdint>
#include <span>

namespace dmpc::core {

/// As long as large pages are on most computers.
inline constexpr std::size_t large_page_bytes = std::size_t{2} << 20U;

/// Asks for them, where `first` begins one. A wish: small pages do, too. Thread-safe.
inline void wish_large_pages(void* first, std::size_t bytes) noexcept { ::madvise(first, bytes, MADV_HUGEPAGE); }

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
