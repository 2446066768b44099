// Computers of each kind, by number, on all of which a strategy is to show the same.
#pragma once

#include <cstdint>
#include <optional>

#include "nodes/computer_request.h"

namespace dmpc::tests {

/// 0: threads; 1: a pool of two; 2: a model; 3: threads that chaos disturbs.
inline nodes::ComputerRequest computer_of_kind(int number, std::uint32_t nodes, std::uint64_t seed) {
  return {.node_count = nodes,
          .chaos = number == 3 ? std::optional(nodes::chaos_of(seed)) : std::nullopt,
          .pool_threads = number == 1 ? std::optional(2U) : std::nullopt,
          .machine = number == 2 ? std::optional(nodes::Machine{}) : std::nullopt};
}

}  // namespace dmpc::tests
