#include "apps/main/allocation.h"

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

#include <malloc.h>

#include <cstddef>
#include <cstdlib>
#include <new>

#include "core/base/filling.h"

namespace dmpc::apps {
namespace {

/// nullptr if memory is exhausted. Both are released by free().
void* block(std::size_t bytes) {
  if (bytes < core::large_page_bytes) {
    return std::malloc(bytes == 0 ? 1 : bytes);
  }
  void* first = nullptr;
  if (::posix_memalign(&first, core::large_page_bytes, bytes) != 0) {
    return nullptr;
  }
  core::wish_large_pages(first, bytes);
  return first;
}

}  // namespace

void keep_freed_memory() {
  ::mallopt(M_MMAP_THRESHOLD, 32 << 20);  // glibc takes no more
  ::mallopt(M_TRIM_THRESHOLD, 128 << 20);
}

}  // namespace dmpc::apps

/// Standard behaviour, except for the pages of large blocks. The standard library's operator delete calls free().
void* operator new(std::size_t bytes) {
  for (;;) {
    if (void* const first = dmpc::apps::block(bytes); first != nullptr) {
      return first;
    }
    const std::new_handler handler = std::get_new_handler();
    if (handler == nullptr) {
      throw std::bad_alloc();
    }
    handler();
  }
}

#else

namespace dmpc::apps {
void keep_freed_memory() {}
}  // namespace dmpc::apps

#endif
