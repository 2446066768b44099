// What can be shown of a pixel in addition to its light: its cost.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace dmpc::core {

/// Kinds of heat maps.
enum class HeatKind : std::uint8_t {
  faults,      ///< requests for pages that its rays started
  references,  ///< look-ups of a page, each counted once
  pages,       ///< distinct pages looked up
  rays,        ///< rays shot
  time,        ///< picoseconds of computing
  node,        ///< number of the node that the pixel belongs to
  depth,       ///< depth of its deepest ray; 1: a primary ray
  samples,     ///< light samples on the film
  done         ///< nanoseconds from the start of the run until its last ray was processed
};
inline constexpr std::array<std::string_view, 9> heat_kind_names = {"faults", "references", "pages",   "rays", "time",
                                                                    "node",   "depth",      "samples", "done"};
constexpr std::string_view name_of(HeatKind kind) { return heat_kind_names[static_cast<std::size_t>(kind)]; }

}  // namespace dmpc::core
