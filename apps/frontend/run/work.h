// What a node that renders is busy with, by what it was charged.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "nodes/observer.h"
#include "nodes/observers/activity_profile.h"

namespace dmpc::apps {

/// What a call of a program was for.
enum class Doing : std::uint8_t {
  trace,    ///< rays
  shade,    ///< a hit, and perhaps rays too
  install,  ///< a page, and nothing else
  pack,     ///< rays into packets or out of them, and nothing else
  other     ///< whatever has no price
};
/// From a bit for each core::Charge that it was charged.
Doing doing_of(nodes::ChargeBits charged);

/// What a node is busy with.
enum class Work : std::uint8_t {
  tracing,   ///< rays, and what their hits look like
  shading,   ///< hits, and the rays that they shoot
  paging,    ///< installing pages and serving them to others
  packing,   ///< rays into packets and out of them
  messages,  ///< sending and taking over packets (modelled machines)
  overhead   ///< what has no price
};
inline constexpr std::array<std::string_view, nodes::work_count> work_names = {"tracing", "shading",  "paging",
                                                                               "packing", "messages", "overhead"};
/// The number of the Work that a span counts as: for a nodes::ActivityProfile.
std::size_t work_of(const nodes::Span& span);

}  // namespace dmpc::apps
