// Two numbers for a pixel's sample: evenly spread for any number of samples, the same on every node and in every order.
#pragma once

#include <cstdint>

#include "core/base/vec.h"

namespace dmpc::core {

/// Each in [0, 1), a multiple of 2^-32.
struct SamplePair {
  double x = 0, y = 0;
  constexpr bool operator==(const SamplePair&) const = default;
};

/// The pairs with one number over a pixel's samples form Sobol's (0, 2)-sequence (I. M. Sobol, "On the Distribution of Points in
/// a Cube", 1967): of the first 2^k, and of each 2^k that follow on a multiple of 2^k, each lies in a box of its own, for every
/// division of the unit square into 2^k equal boxes of 2^i by 2^(k - i). The digits are scrambled by a hash of pixel and pair
/// after A. B. Owen, so that every place is equally likely, by the method of B. Burley, "Practical Hash-based Owen Scrambling",
/// Journal of Computer Graphics Techniques 9 (4), 2020.
///
/// From pair 1 on the sample's number is scrambled in the same way by another hash, so that the pairs of a sample are independent
/// (Burley, section 5, "Padding"), while 2^k samples as above keep a box each. Pair 0 keeps its order. Thread safety: pure.
SamplePair sample_pair(std::uint32_t pixel, std::uint32_t sample, std::uint32_t pair);

/// In a pixel whose sides are 1 long.
using SamplePosition = SamplePair;

/// Pair 0 of the sample's numbers: consecutive ones fill a pixel evenly.
inline SamplePosition sample_position(std::uint32_t pixel, std::uint32_t sample) { return sample_pair(pixel, sample, 0); }

/// A place on the unit disc.
struct DiscPlace {
  double x, y;
  double square;  ///< squared distance from the middle
};

/// A uniform point on the disc for a uniform pair: P. Shirley, K. Chiu, "A Low Distortion Map Between Disk and Square", Journal
/// of Graphics Tools 2 (3), 1997.
DiscPlace on_disc(const SamplePair& pair);

/// `x`, `y` and `along` on orthogonal axes, of which the last is the unit vector `axis`: T. Duff and others, "Building an
/// Orthonormal Basis, Revisited", Journal of Computer Graphics Techniques 6 (1), 2017.
Vec3d about_axis(const Vec3d& axis, double x, double y, double along);

}  // namespace dmpc::core
