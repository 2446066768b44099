// Sizes in bytes as text.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <utility>

namespace dmpc::nodes {

/// "4MiB", "300KiB" or "1000B", exact: as the command line reads sizes.
inline std::string size_text(std::size_t bytes) {
  constexpr std::array<std::pair<std::size_t, const char*>, 3> units = {{{30, "GiB"}, {20, "MiB"}, {10, "KiB"}}};
  for (const auto& [shift, name] : units) {
    if (bytes != 0 && bytes % (std::size_t{1} << shift) == 0) {
      return std::to_string(bytes >> shift) + name;
    }
  }
  return std::to_string(bytes) + "B";
}

}  // namespace dmpc::nodes
