// A modelled machine on which everything takes time, no two operations the same.
#pragma once

#include <cstddef>

#include "nodes/machine.h"

namespace dmpc::tests {

inline nodes::Machine priced_machine() {
  nodes::Machine machine{.name = "priced", .topology = nodes::TopologyKind::hypercube};
  machine.short_message = machine.long_message = {.send_ns = 1000, .latency_ns = 2000, .receive_ns = 1000, .byte_ps = 100'000};
  for (std::size_t i = 0; i < machine.cost_ps.size(); ++i) {
    machine.cost_ps[i] = 10'000 + 1'001 * i;
  }
  return machine;
}

}  // namespace dmpc::tests
