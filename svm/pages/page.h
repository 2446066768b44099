// The page: a numbered piece of the database, all of one size, and a record's offset in it.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/expect.h"
#include "core/record/record.h"

namespace dmpc::svm {

/// Page p is the p-th piece of the database, counted from 0.
enum class PageId : std::uint32_t {};
inline constexpr PageId no_page{0xffffffffU};

constexpr std::uint32_t index_of(PageId page) { return static_cast<std::uint32_t>(page); }

/// One more than the greatest page in `pages`; 0 if there are none.
constexpr std::uint32_t page_bound_of(std::span<const PageId> pages) {
  std::uint32_t bound = 0;
  for (const PageId page : pages) {
    bound = index_of(page) < bound ? bound : index_of(page) + 1;
  }
  return bound;
}

inline constexpr std::size_t page_size_min_bytes = 512;
inline constexpr std::size_t page_size_max_bytes = 65536;
static_assert(page_size_min_bytes == std::bit_ceil(core::record_bytes_max), "the smallest page holds the largest record");

/// Whether this is a valid page size: a power of two from 512 B to 64 KiB.
constexpr bool is_page_size(std::size_t bytes) {
  return std::has_single_bit(bytes) && bytes >= page_size_min_bytes && bytes <= page_size_max_bytes;
}

/// From a record's address to its page and its offset there, by shifts.
class PageGeometry {
 public:
  /// Expects is_page_size(page_size_bytes).
  explicit PageGeometry(std::size_t page_size_bytes)
      : shift_(static_cast<std::uint32_t>(std::countr_zero(page_size_bytes / core::record_alignment))),
        size_bytes_(page_size_bytes) {
    core::expect(is_page_size(page_size_bytes), "a page is a power of two from 512 B to 64 KiB");
  }

  std::size_t size_bytes() const { return size_bytes_; }
  PageId page_of(core::Address address) const { return PageId{static_cast<std::uint32_t>(address) >> shift_}; }
  /// Offset from the page's first byte.
  std::size_t offset_of(core::Address address) const {
    return static_cast<std::size_t>(core::byte_offset(address)) & (size_bytes_ - 1);
  }

 private:
  std::uint32_t shift_;
  std::size_t size_bytes_;
};

}  // namespace dmpc::svm
