#include "core/base/srgb.h"

#include <array>
#include <bit>
#include <cstddef>

namespace dmpc::core {

namespace {

/// limits[b]: the linear value half-way (on the encoded scale) between bytes b and b + 1.
constexpr std::array<double, 255> byte_limits() {
  std::array<double, 255> limits{};
  for (std::size_t byte = 0; byte < limits.size(); ++byte) {
    limits[byte] = linear_from_srgb((static_cast<double>(byte) + 0.5) / 255);
  }
  return limits;
}

/// A bin holds the floats with the same exponent and the same first bits of the fraction, and spans at most two limits. Bins
/// begin at the least value that byte 1 can have, and end at 1.
constexpr int fraction_bits = 23, bin_bits = 7;
constexpr std::uint32_t bin_of(float linear) { return std::bit_cast<std::uint32_t>(linear) >> (fraction_bits - bin_bits); }
constexpr float darkest = 0x1p-13F;
constexpr std::uint32_t first_bin = bin_of(darkest), bin_count = bin_of(1.0F) - first_bin;

constexpr std::array<double, 255> limits = byte_limits();
static_assert(limits[0] > double{darkest} && limits[254] < 1);

/// For each bin, the byte of its least value.
constexpr std::array<std::uint8_t, bin_count> least_bytes = [] {
  std::array<std::uint8_t, bin_count> bytes{};
  std::size_t byte = 0;
  for (std::uint32_t bin = 0; bin < bin_count; ++bin) {
    const auto least = std::bit_cast<float>((first_bin + bin) << (fraction_bits - bin_bits));
    while (byte < limits.size() && limits[byte] < double{least}) {
      ++byte;
    }
    bytes[bin] = static_cast<std::uint8_t>(byte);
  }
  return bytes;
}();

}  // namespace

std::uint8_t srgb_byte(float linear) {
  if (!(linear >= darkest)) {
    return 0;
  }
  if (linear >= 1) {
    return 255;
  }
  std::size_t byte = least_bytes[bin_of(linear) - first_bin];
  while (byte < limits.size() && limits[byte] < double{linear}) {
    ++byte;
  }
  return static_cast<std::uint8_t>(byte);
}

}  // namespace dmpc::core
