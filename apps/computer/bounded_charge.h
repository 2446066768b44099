// Charges of a program of somebody's own, of which no sum wraps.
#pragma once

#include <cstdint>
#include <string>

#include "apps/computer/dmpc/computer.h"
#include "apps/computer/options.h"

namespace dmpc::apps {

/// So often a node may charge an operation in a run: the sum over all nodes is counted in 64 bits.
inline constexpr std::uint64_t charges_max = std::uint64_t{1} << 51U;
static_assert(charges_max <= ~std::uint64_t{0} / program_nodes_max);

/// Adds `count` to what has been charged of an operation, which messages call `name`. Throws ProgramError if that is too much.
inline void charge_within_bounds(std::uint64_t& total, std::uint64_t count, const std::string& name) {
  if (count > charges_max - total) {
    throw ProgramError("operation " + name + " is charged " + std::to_string(count) + " times more, beside " +
                       std::to_string(total) + " before: at most " + std::to_string(charges_max) + " are counted at a node");
  }
  total += count;
}

}  // namespace dmpc::apps
