// Classifies the activity of a rendering node by its charges.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "apps/frontend/run/time_parts.h"
#include "nodes/observer.h"
#include "nodes/observers/activity_profile.h"

namespace dmpc::apps {

/// The purpose of a program's call.
enum class Doing : std::uint8_t {
  trace,    ///< rays
  shade,    ///< a hit, and perhaps rays too
  install,  ///< a page, and nothing else
  pack,     ///< rays into packets or out of them, and nothing else
  other     ///< whatever has no price
};
/// From a bit set of the charges of type core::Charge.
Doing doing_of(nodes::ChargeBits charged);

/// A node's kind of activity: TimePart::computing by purpose, and the other parts in which a node is not idle.
enum class Work : std::uint8_t {
  tracing,     ///< rays, and what their hits look like
  shading,     ///< hits, and the rays that they shoot
  installing,  ///< pages
  packing,     ///< rays into packets and out of them
  overhead,    ///< what has no price
  service_busy,
  service_idle,
  messages
};
inline constexpr std::array<std::string_view, nodes::work_count> work_names = {
    "tracing", "shading", "installing", "packing", "overhead", service_busy_words, service_idle_words, "messages"};
/// The number of the Work that a span counts as: for a nodes::ActivityProfile.
std::size_t work_of(const nodes::Span& span);

}  // namespace dmpc::apps
