// Where in its pixel a sample lies: evenly spread for any number of samples, the same on every node and in every order.
#pragma once

#include <cstdint>

namespace dmpc::core {

/// In a pixel whose sides are 1 long; each coordinate in [0, 1), a multiple of 2^-32.
struct SamplePosition {
  double x = 0, y = 0;
  constexpr bool operator==(const SamplePosition&) const = default;
};

/// A pixel's samples are Sobol's (0, 2)-sequence (I. M. Sobol, "On the Distribution of Points in a Cube", 1967): of the first
/// 2^k, and of each 2^k that follow upon a multiple of 2^k, each lies in a box of its own, for every way of cutting the pixel
/// into 2^k equal boxes of 2^i by 2^(k - i). The digits are scrambled by a hash of the pixel after A. B. Owen, so that every
/// position is equally likely, by the method of B. Burley, "Practical Hash-based Owen Scrambling", Journal of Computer Graphics
/// Techniques 9 (4), 2020.
SamplePosition sample_position(std::uint32_t pixel, std::uint32_t sample);

}  // namespace dmpc::core
