// Sample positions: a hash of (pixel, sample, dimension), the same on every node and in every order.
#pragma once

#include <cstdint>

namespace dmpc::core {

/// Mixes 64 bits (the finaliser of G. Steele, D. Lea, C. Flood, "Fast Splittable Pseudorandom Number Generators", 2014).
constexpr std::uint64_t mix(std::uint64_t value) {
  value = (value ^ (value >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  value = (value ^ (value >> 27U)) * 0x94d049bb133111ebULL;
  return value ^ (value >> 31U);
}

/// Uniform in [0, 1), a multiple of 2^-53.
constexpr double sample_value(std::uint32_t pixel, std::uint32_t sample, std::uint32_t dimension) {
  const std::uint64_t key = mix((std::uint64_t{pixel} << 32U | sample) + 0x9e3779b97f4a7c15ULL) + dimension;
  return static_cast<double>(mix(key + 0x9e3779b97f4a7c15ULL) >> 11U) * 0x1p-53;
}

}  // namespace dmpc::core
