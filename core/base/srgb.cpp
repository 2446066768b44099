#include "core/base/srgb.h"

#include <algorithm>
#include <array>
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

}  // namespace

std::uint8_t srgb_byte(float linear) {
  static constexpr std::array<double, 255> limits = byte_limits();
  if (!(linear > 0)) {
    return 0;
  }
  const auto above = std::lower_bound(limits.begin(), limits.end(), static_cast<double>(linear));
  return static_cast<std::uint8_t>(above - limits.begin());
}

}  // namespace dmpc::core
