// Requests large pages from the operating system where many bytes are about to be written.
#pragma once

#include <sys/mman.h>
#include <cstddef>
#include <cstdint>
#include <span>

namespace dmpc::core {

/// The size of a large page on most computers.
inline constexpr std::size_t large_page_bytes = std::size_t{2} << 20U;

/// Requests large pages; `first` is the beginning of one. This is a hint: small pages work, too. Thread-safe.
inline void wish_large_pages(void* first, std::size_t bytes) noexcept { ::madvise(first, bytes, MADV_HUGEPAGE); }

/// Call this before all of `bytes` are written, and maybe none beside them: requests the large pages that lie wholly in them,
/// which saves a page fault for each small page. Thread-safe.
inline void begin_filling(std::span<std::byte> bytes) noexcept {
  const auto begin = reinterpret_cast<std::uintptr_t>(bytes.data());
  const std::size_t before = (large_page_bytes - begin % large_page_bytes) % large_page_bytes;
  if (bytes.size() >= before + large_page_bytes) {
    wish_large_pages(bytes.data() + before, (bytes.size() - before) / large_page_bytes * large_page_bytes);
  }
}

}  // namespace dmpc::core
