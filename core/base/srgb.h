// The sRGB curve (IEC 61966-2-1), by arithmetic alone, so that an 8-bit picture is the same on every machine.
#pragma once

#include <algorithm>
#include <cstdint>

namespace dmpc::core {

/// The fifth root of `value` in (0, 1], by Newton's method from above; it decreases until rounding stops it.
constexpr double fifth_root(double value) {
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

/// Linear light of an encoded value, both in [0, 1]: x/12.92 up to 0.04045, ((x + 0.055) / 1.055)^2.4 above. Values outside are
/// clamped. Tables of it are computed at compile time: at program start, a linked library may have changed the rounding.
constexpr double linear_from_srgb(double encoded) {
  if (!(encoded > 0)) {
    return 0;
  }
  encoded = std::min(encoded, 1.0);
  const double base = (encoded + 0.055) / 1.055;
  return encoded <= 0.04045 ? encoded / 12.92 : base * base * fifth_root(base * base);
}

/// The byte whose encoded value is nearest to that of `linear`, clamped to 0..255; NaN gives 0. Exact: it compares with the
/// linear values half-way between neighbouring bytes.
std::uint8_t srgb_byte(float linear);

}  // namespace dmpc::core
