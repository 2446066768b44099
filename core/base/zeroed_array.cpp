#include "core/base/zeroed_array.h"

#include <sys/mman.h>

#include <cstdlib>
#include <new>

namespace dmpc::core {
namespace {

/// So many bytes and more have pages of their own: large ones, which have 2 MiB on most computers, where the system has them.
constexpr bool has_pages(std::size_t bytes) { return bytes >= std::size_t{2} << 20U; }

/// Returns nullptr if there is no room.
void* map(std::size_t bytes) {
  void* const first = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (first == MAP_FAILED) {
    return nullptr;
  }
  ::madvise(first, bytes, MADV_HUGEPAGE);  // a wish: small pages do, too
  return first;
}

}  // namespace

void* allocate_zeros(std::size_t bytes) {
  void* const first = has_pages(bytes) ? map(bytes) : std::calloc(1, bytes);
  return first != nullptr ? first : throw std::bad_alloc();
}

void free_zeros(void* first, std::size_t bytes) noexcept {
  if (has_pages(bytes)) {
    ::munmap(first, bytes);
  } else {
    std::free(first);
  }
}

}  // namespace dmpc::core
