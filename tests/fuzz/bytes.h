// An input of the fuzzer as a source of choices and numbers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#include "core/base/vec.h"

namespace dmpc::tests {

/// Takes bytes from the front; zeros when they are used up. What is chosen by one byte stays where it is when others change, so
/// that a fuzzer can alter one thing at a time.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}

  bool empty() const { return left_ == 0; }

  std::uint8_t byte() {
    std::uint8_t value = 0;
    take(&value, 1);
    return value;
  }
  /// Below `count`, from 1 to 256, by one byte.
  std::size_t below(std::size_t count) { return byte() % count; }
  std::uint16_t word() {
    std::uint16_t value = 0;
    take(&value, sizeof(value));
    return value;
  }
  /// Any bits: NaN, infinities and denormal numbers too.
  float raw() {
    float value = 0;
    take(&value, sizeof(value));
    return value;
  }
  /// A multiple of 1/16 from -8 to 8.
  double nice() { return (byte() - 128) / 16.0; }
  /// What arithmetic stumbles over, by one byte.
  float odd() {
    constexpr float infinite = std::numeric_limits<float>::infinity();
    constexpr std::array<float, 20> odd{0.0F,   -0.0F,   infinite, -infinite, std::numeric_limits<float>::quiet_NaN(),
                                        3e38F,  -3e38F,  1e-40F,   -1e-40F,   1e-30F,
                                        1e-18F, -1e-17F, 0.5F,     1.0F,      -1.0F,
                                        1e10F,  -1e20F,  1e29F,    0x1p-21F,  0x1p-24F};
    return odd[below(odd.size())];
  }

  /// A point of the lattice of halves from -1 to 1, by one byte: different bytes often give points in line.
  core::Vec3d lattice_point() {
    const std::size_t i = below(125);
    const auto coordinate = [](std::size_t digit) { return (static_cast<double>(digit) - 2) / 2; };
    return {coordinate(i % 5), coordinate(i / 5 % 5), coordinate(i / 25)};
  }
  core::Vec3d nice_point() {
    const double x = nice(), y = nice();
    return {x, y, nice()};
  }
  core::Vec3f odd_point() {
    const float x = odd(), y = odd();
    return {x, y, odd()};
  }
  core::Vec3f raw_point() {
    const float x = raw(), y = raw();
    return {x, y, raw()};
  }

 private:
  void take(void* value, std::size_t size) {
    const std::size_t count = size < left_ ? size : left_;
    std::memcpy(value, data_, count);
    data_ += count;
    left_ -= count;
  }

  const std::uint8_t* data_;
  std::size_t left_;
};

}  // namespace dmpc::tests
