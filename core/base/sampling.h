// A hash for values that must look random but be the same on every node and in every order.
#pragma once

#include <cstdint>

namespace dmpc::core {

/// Mixes 64 bits (the finaliser of G. Steele, D. Lea, C. Flood, "Fast Splittable Pseudorandom Number Generators", 2014).
constexpr std::uint64_t mix(std::uint64_t value) {
  value = (value ^ (value >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  value = (value ^ (value >> 27U)) * 0x94d049bb133111ebULL;
  return value ^ (value >> 31U);
}

}  // namespace dmpc::core
