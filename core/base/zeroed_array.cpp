#include "core/base/zeroed_array.h"

#include <sys/mman.h>

#include <cstdlib>
#include <new>

#include "core/base/filling.h"
#include "core/base/units.h"

namespace dmpc::core {
namespace {

/// An array of this size or more is mapped directly. malloc() stops doing so as soon as something as large has been freed, and
/// then calloc() writes the zeros: with 1,024 nodes every byte of their memories was touched before they began.
constexpr bool has_pages(std::size_t bytes) { return bytes >= std::size_t{128} << 10U; }

constexpr std::size_t whole_pages(std::size_t bytes) { return round_up(bytes, std::size_t{4} << 10U); }

/// Returns nullptr if there is not enough memory.
void* map(std::size_t bytes) {
  void* const mapped = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  return mapped == MAP_FAILED ? nullptr : mapped;
}

/// Maps small pages, none of which is committed before it is touched, unless core/base/filling.h requests large ones. Returns as
/// map().
void* map_small(std::size_t length) {
  void* const first = map(length);
  if (first != nullptr) {
    ::madvise(first, length, MADV_NOHUGEPAGE);  // a hint, like the other: systems without large pages refuse it
  }
  return first;
}

/// Maps memory that begins at a large page. The system places a mapping anywhere, and the parts before its first large page and
/// after its last one have small pages. Returns as map().
void* map_large(std::size_t length) {
  void* const mapped = map(length + large_page_bytes);
  if (mapped == nullptr) {
    return nullptr;
  }
  const std::size_t before = (large_page_bytes - reinterpret_cast<std::uintptr_t>(mapped) % large_page_bytes) % large_page_bytes;
  std::byte* const first = static_cast<std::byte*>(mapped) + before;
  if (before != 0) {
    ::munmap(mapped, before);
  }
  ::munmap(first + length, large_page_bytes - before);
  wish_large_pages(first, length);
  return first;
}

}  // namespace

void* allocate_zeros(std::size_t bytes, Touching touching) {
  const bool is_large = bytes >= large_page_bytes && touching == Touching::all;
  void* const first = is_large           ? map_large(whole_pages(bytes))
                      : has_pages(bytes) ? map_small(whole_pages(bytes))
                                         : std::calloc(1, bytes);
  return first != nullptr ? first : throw std::bad_alloc();
}

void free_zeros(void* first, std::size_t bytes) noexcept {
  if (has_pages(bytes)) {
    ::munmap(first, whole_pages(bytes));
  } else {
    std::free(first);
  }
}

}  // namespace dmpc::core
