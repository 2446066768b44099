// Morton order keeps neighbours in space near each other in memory (G. Morton, 1966).
#pragma once

#include <cstdint>

namespace dmpc::core {

/// Spreads the low 21 bits of `value` to every third bit.
constexpr std::uint64_t spread_bits(std::uint64_t value) {
  value &= 0x1fffffU;
  value = (value | value << 32U) & 0x1f00000000ffffULL;
  value = (value | value << 16U) & 0x1f0000ff0000ffULL;
  value = (value | value << 8U) & 0x100f00f00f00f00fULL;
  value = (value | value << 4U) & 0x10c30c30c30c30c3ULL;
  return (value | value << 2U) & 0x1249249249249249ULL;
}

/// Interleaves three coordinates below 2^21.
constexpr std::uint64_t morton_code(std::uint64_t x, std::uint64_t y, std::uint64_t z) {
  return spread_bits(x) | spread_bits(y) << 1U | spread_bits(z) << 2U;
}

}  // namespace dmpc::core
