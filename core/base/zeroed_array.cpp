#include "core/base/zeroed_array.h"

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>

#include "core/base/large_pages.h"
#include "core/base/units.h"

namespace dmpc::core {
namespace {

/// So many bytes and more have pages of their own.
constexpr bool has_pages(std::size_t bytes) { return bytes >= large_page_bytes; }

constexpr std::size_t whole_pages(std::size_t bytes) { return round_up(bytes, std::size_t{4} << 10U); }

/// Begins where a large page does: the system places a mapping anywhere, and what lies before its first large page and behind its
/// last one has small pages. Returns nullptr if there is no room.
void* map(std::size_t bytes) {
  const std::size_t length = whole_pages(bytes);
  void* const mapped = ::mmap(nullptr, length + large_page_bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (mapped == MAP_FAILED) {
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

void* allocate_zeros(std::size_t bytes) {
  void* const first = has_pages(bytes) ? map(bytes) : std::calloc(1, bytes);
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
