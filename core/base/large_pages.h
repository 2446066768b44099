// Pages as large as the operating system has them.
#pragma once

#include <sys/mman.h>

#include <cstddef>

namespace dmpc::core {

/// As long as large pages are on most computers.
inline constexpr std::size_t large_page_bytes = std::size_t{2} << 20U;

/// Asks for them, where `first` begins one. A wish: small pages do, too. Thread-safe.
inline void wish_large_pages(void* first, std::size_t bytes) noexcept { ::madvise(first, bytes, MADV_HUGEPAGE); }

}  // namespace dmpc::core
