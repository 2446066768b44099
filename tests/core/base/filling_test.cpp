#include "core/base/filling.h"

#include <doctest/doctest.h>
#include <sys/mman.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
namespace dmpc::core::filling_test {
namespace {

constexpr std::size_t page_bytes = 4096;

std::ptrdiff_t resident_pages(std::byte* first, std::size_t bytes) {
  std::array<unsigned char, large_page_bytes / page_bytes> is_resident{};
  REQUIRE(::mincore(first, bytes, is_resident.data()) == 0);
  return std::count_if(is_resident.begin(), is_resident.end(), [](unsigned char one) { return (one & 1U) != 0; });
}

}  // namespace

TEST_CASE("bytes that are about to be filled take nothing of what lies beside them") {
  constexpr std::size_t length = 4 * large_page_bytes;
  void* const mapped = ::mmap(nullptr, length, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  REQUIRE(mapped != MAP_FAILED);
  ::madvise(mapped, length, MADV_NOHUGEPAGE);
  auto* const begin = static_cast<std::byte*>(mapped);
  std::byte* const aligned = begin + (large_page_bytes - reinterpret_cast<std::uintptr_t>(begin) % large_page_bytes);
  const std::span<std::byte> bytes(aligned + page_bytes, 2 * large_page_bytes - page_bytes + 1);
  begin_filling(bytes);
  bytes.front() = bytes.back() = std::byte{1};
  CHECK(resident_pages(aligned, large_page_bytes) == 1);
  CHECK(resident_pages(aligned + 2 * large_page_bytes, large_page_bytes) == 1);
  ::munmap(mapped, length);
}

}  // namespace dmpc::core::filling_test
#endif
