// What is counted over draws of a machine's prices (apps/frontend/machine/drawn_machine.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "apps/lab/study/systems/verdict.h"

namespace dmpc::apps {

/// In how many draws each row is the fastest, by more than a tie. `seconds`: by draw and row.
std::vector<std::uint32_t> first_in(const std::vector<std::vector<double>>& seconds);
/// In how many draws `row` is faster than `other`, by more than a tie.
AheadInDraws ahead_in(const std::vector<std::vector<double>>& seconds, std::size_t row, std::size_t other);

}  // namespace dmpc::apps
