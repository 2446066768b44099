// What a program counts of its items, for the tests of heat maps.
#pragma once

#include <cstdint>

namespace dmpc::nodes {

/// The computer's own stand anywhere.
enum class ToyKind : std::uint8_t { bites, depth, steps, time, crumbs, node, drops, done };

}  // namespace dmpc::nodes
