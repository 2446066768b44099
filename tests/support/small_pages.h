// The pages that tests of the pager fetch.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/record/record.h"

namespace dmpc::tests {

inline constexpr std::size_t page_size = 512;
inline constexpr std::uint32_t page_count = 40;

inline core::Address start_of(std::uint32_t page) {
  return core::Address{static_cast<std::uint32_t>(page * page_size / core::record_alignment)};
}

}  // namespace dmpc::tests
