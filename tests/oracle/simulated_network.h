// Messages by SimGrid's S4U: links are semaphores that messages, its actors, take and give back. An independent judge of
// nodes/virtual/links.h: another's clock, queues and order of events (H. Casanova and others, "Versatile, Scalable, and Accurate
// Simulation of Distributed Applications and Platforms", 2014).
#pragma once

#include <cstdint>
#include <vector>

#include "nodes/machine.h"
#include "nodes/node_id.h"

namespace dmpc::tests {

/// A message of `bytes` bytes that enters the network at a time.
struct TimedMessage {
  std::uint64_t enters_ns = 0;
  nodes::NodeId source{}, target{};
  std::uint64_t bytes = 0;
};

/// When each message has arrived, in nanoseconds, by SimGrid, in a process of its own, since it simulates once a process. A
/// circuit is taken link by link, a hop each, and held from there on until its message has arrived; packets hold each link for
/// their hop and bytes. Throws std::runtime_error if the simulation comes to no end.
std::vector<double> arrivals_by_simgrid(const nodes::Machine& machine, std::uint32_t node_count,
                                        const std::vector<TimedMessage>& messages);

}  // namespace dmpc::tests
