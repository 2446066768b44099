#include "core/base/zeroed_array.h"

#include <cstdlib>
#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace dmpc::core {
namespace {

/// From here on large pages, which have 2 MiB on most computers, are worth a wish.
constexpr std::size_t large_bytes_min = std::size_t{2} << 20U;

}  // namespace

#if defined(__linux__)

void* allocate_zeros(std::size_t bytes) {
  if (bytes < large_bytes_min) {
    void* const first = std::calloc(1, bytes);
    return first != nullptr ? first : throw std::bad_alloc();
  }
  void* const first = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (first == MAP_FAILED) {
    throw std::bad_alloc();
  }
  ::madvise(first, bytes, MADV_HUGEPAGE);  // a wish: where the system has none, small pages do
  return first;
}

void free_zeros(void* first, std::size_t bytes) noexcept {
  if (bytes < large_bytes_min) {
    std::free(first);
  } else {
    ::munmap(first, bytes);
  }
}

#else

void* allocate_zeros(std::size_t bytes) {
  void* const first = std::calloc(1, bytes);
  return first != nullptr ? first : throw std::bad_alloc();
}

void free_zeros(void* first, std::size_t) noexcept { std::free(first); }

#endif

}  // namespace dmpc::core
