// Draws of a machine's prices within what their sources say of their certainty.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "apps/frontend/machine/machines.h"
#include "apps/lab/study/systems/verdict.h"
#include "nodes/machine.h"

namespace dmpc::apps {

inline constexpr std::uint64_t draw_seed = 1994;

/// Returns the factor within which a price lies by the lowest certainty in its source: 1.1 for high, 1.3 for medium, 2 for low
/// and for none. A source may have several clauses, with semicolons between: those that name `part` count, or, if none does,
/// those that name no part.
double doubt_of(std::string_view source, std::string_view part);

/// The machine of a draw: each price multiplied by its doubt to the power of a number from -1 to 1. A number belongs to a draw
/// and a price, not to a machine. Prices with one source are drawn together: both ends of a message, its latency and bytes, and
/// all operations but those that the source names. The network's form stays.
nodes::Machine drawn(const MachineDescription& description, std::uint32_t draw);

/// In how many draws each row is the fastest, by more than a tie. `seconds`: by draw and row.
std::vector<std::uint32_t> first_in(const std::vector<std::vector<double>>& seconds);
/// In how many draws `row` is faster than `other`, by more than a tie.
AheadInDraws ahead_in(const std::vector<std::vector<double>>& seconds, std::size_t row, std::size_t other);

}  // namespace dmpc::apps
