// Byte units and integer division that rounds up.
#pragma once

#include <cstddef>

namespace dmpc::core {

constexpr std::size_t operator""_KiB(unsigned long long count) { return count << 10U; }
constexpr std::size_t operator""_MiB(unsigned long long count) { return count << 20U; }

/// The least q with q * divisor >= value; divisor > 0.
template <class Integer>
constexpr Integer ceil_divide(Integer value, Integer divisor) {
  return static_cast<Integer>((value + divisor - 1) / divisor);
}

/// The least multiple of `alignment` that is >= value; alignment > 0.
template <class Integer>
constexpr Integer round_up(Integer value, Integer alignment) {
  return static_cast<Integer>(ceil_divide(value, alignment) * alignment);
}

}  // namespace dmpc::core
