// Pictures of Radiance's, with random components.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/sampling.h"

namespace dmpc::tests {

struct HdrKind {
  int width = 50, height = 20;
  std::string head = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n", rows = "-Y ", columns = " +X ";
  bool has_runs = false;
};

/// A component of a row: runs of one value, or as many different ones as may stand together. Exponents are those of light that
/// may be.
inline std::string hdr_component(int width, bool has_runs, bool is_exponent, std::uint64_t seed) {
  std::string packed;
  for (int place = 0; place < width;) {
    const std::uint64_t random = core::mix(seed << 16U | static_cast<std::uint64_t>(place));
    const int count = std::min(1 + static_cast<int>(random % (has_runs ? 127 : 128)), width - place);
    const bool is_run = has_runs && random >> 40U & 1U;
    packed += static_cast<char>(is_run ? 128 + count : count);
    for (int i = 0; i < (is_run ? 1 : count); ++i) {
      const std::uint64_t value = core::mix(random + static_cast<std::uint64_t>(i));
      packed += static_cast<char>(is_exponent ? value % 16 == 0 ? 0 : 64 + value / 16 % 129 : value);
    }
    place += count;
  }
  return packed;
}

inline std::string hdr_of(const HdrKind& kind) {
  std::string file = kind.head + kind.rows + std::to_string(kind.height) + kind.columns + std::to_string(kind.width) + "\n";
  for (int row = 0; row < kind.height; ++row) {
    file += {'\2', '\2', static_cast<char>(kind.width >> 8), static_cast<char>(kind.width)};
    for (int component = 0; component < 4; ++component) {
      file += hdr_component(kind.width, kind.has_runs, component == 3, static_cast<std::uint64_t>(4 * row + component));
    }
  }
  return file;
}

/// All mantissas, one a column, with each of these exponents, one a row.
inline std::string hdr_of_all(unsigned first_exponent, unsigned last_exponent) {
  std::string file =
      "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(last_exponent - first_exponent + 1) + " +X 256\n";
  for (unsigned exponent = first_exponent; exponent <= last_exponent; ++exponent) {
    file += std::string("\2\2\1\0", 4);
    for (int component = 0; component < 4; ++component) {
      for (unsigned column = 0; column < 256; ++column) {
        file += column % 128 == 0 ? "\200" : "";
        file += static_cast<char>(component == 3 ? exponent : column);
      }
    }
  }
  return file;
}

}  // namespace dmpc::tests
