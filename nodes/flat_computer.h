// A computer request as bytes, for the ranks on which the computer is.
#pragma once

#include <cstdint>
#include <optional>

#include "core/base/expect.h"
#include "nodes/computer_request.h"
#include "nodes/flat_bytes.h"

namespace dmpc::nodes {

/// All of it but the ranks. Requires that no machine is modelled.
inline void put(FlatWriter& flat, const ComputerRequest& computer) {
  core::expect(!computer.machine, "a model has no ranks");
  flat.put(computer.node_count);
  flat.put(computer.node_memory_bytes);
  flat.put(computer.stack_reserve_bytes);
  flat.put(computer.chaos);
  flat.put(computer.pool_threads);
}

inline ComputerRequest take_computer(FlatReader& flat, RankLinks& ranks) {
  ComputerRequest computer;
  computer.node_count = flat.take<std::uint32_t>();
  computer.node_memory_bytes = flat.take<std::optional<std::size_t>>();
  computer.stack_reserve_bytes = flat.take<std::size_t>();
  computer.chaos = flat.take<std::optional<Chaos>>();
  computer.pool_threads = flat.take<std::optional<std::uint32_t>>();
  computer.ranks = &ranks;
  return computer;
}

}  // namespace dmpc::nodes
