// Draws of a machine's prices within what their sources say of their certainty.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "apps/frontend/machine/machines.h"
#include "nodes/machine.h"

namespace dmpc::apps {

inline constexpr std::uint64_t draw_seed = 1994;
inline constexpr std::int64_t draw_max = 9999;

/// Returns the factor within which a price lies by the lowest certainty in its source: 1.1 for high, 1.3 for medium, 2 for low
/// and for none. A source may have several clauses, with semicolons between: those that name `part` count, or, if none does,
/// those that name no part.
double doubt_of(std::string_view source, std::string_view part);

/// The machine of a draw: each price multiplied by its doubt to the power of a number from -1 to 1. A number belongs to a draw
/// and a price, not to a machine. Prices with one source are drawn together: both ends of a message, its latency and bytes, and
/// all operations but those that the source names. The network's form stays.
nodes::Machine drawn(const MachineDescription& description, std::uint32_t draw);

}  // namespace dmpc::apps
