// Overflow-safe charges of user programs.
#pragma once

#include <cstdint>
#include <string>

#include "apps/computer/dmpc/computer.h"
#include "apps/computer/options.h"

namespace dmpc::apps {

/// The maximum charges of one operation by a node in a run, since the sum over all nodes is counted in 64 bits.
inline constexpr std::uint64_t charges_max = std::uint64_t{1} << 51U;
static_assert(charges_max <= ~std::uint64_t{0} / program_nodes_max);

/// Adds `count` to an operation's total; `name` is used in messages. Throws ProgramError above the maximum.
inline void charge_within_bounds(std::uint64_t& total, std::uint64_t count, const std::string& name) {
  if (count > charges_max - total) {
    throw ProgramError("operation " + name + " is charged " + std::to_string(count) + " times more, beside " +
                       std::to_string(total) + " before: at most " + std::to_string(charges_max) + " are counted at a node");
  }
  total += count;
}

}  // namespace dmpc::apps
