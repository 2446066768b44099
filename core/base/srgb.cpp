#include "core/base/srgb.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace dmpc::core {

namespace {

/// The fifth root of `value` in (0, 1], by Newton's method from above, where it falls until rounding stops it.
double fifth_root(double value) {
  double root = 1;
  for (;;) {
    const double cube = root * root * root;
    const double next = root - (cube * root * root - value) / (5 * cube * root);
    if (!(next < root)) {
      return root;
    }
    root = next;
  }
}

/// value^2.4 = value^2 * (value^2)^(1/5).
double power_2_4(double value) { return value * value * fifth_root(value * value); }

/// limits[b]: the linear value half-way (on the encoded scale) between bytes b and b + 1.
std::array<double, 255> byte_limits() {
  std::array<double, 255> limits{};
  for (std::size_t byte = 0; byte < limits.size(); ++byte) {
    limits[byte] = linear_from_srgb((static_cast<double>(byte) + 0.5) / 255);
  }
  return limits;
}

}  // namespace

double linear_from_srgb(double encoded) {
  if (!(encoded > 0)) {
    return 0;
  }
  encoded = std::min(encoded, 1.0);
  return encoded <= 0.04045 ? encoded / 12.92 : power_2_4((encoded + 0.055) / 1.055);
}

std::uint8_t srgb_byte(float linear) {
  static const std::array<double, 255> limits = byte_limits();
  if (!(linear > 0)) {
    return 0;
  }
  const auto above = std::lower_bound(limits.begin(), limits.end(), static_cast<double>(linear));
  return static_cast<std::uint8_t>(above - limits.begin());
}

}  // namespace dmpc::core
