// Options of runs with travelling rays; a member of options, runs and plans.
#pragma once

#include <cstdint>
#include <optional>

#include "dataflow/regions/balance.h"
#include "nodes/topology.h"

namespace dmpc::dataflow {

/// `optional` without a value means: choose.
struct RayOptions {
  BalanceOptions balance = {};  ///< how the regions are cut
  /// Rays in a full packet. By default what fills a packet of 4 KiB, or of 2 KiB for single rays, of 1 KiB on a modelled machine,
  /// or fewer if memory is scarce.
  std::optional<std::uint32_t> ray_batch = std::nullopt;
  /// Number of names of tested leaves that a ray carries, so that leaves that reach into other regions are not tested again; each
  /// takes 4 bytes of its message. If it is not 0, rays are traced one by one.
  std::uint32_t tested_objects = 0;
  /// Packets of rays that may be in flight, or in the receiver's backlog, for each sender and receiver. By default 4, with
  /// bundles up to 64 among fewer than 16 nodes, or fewer if memory is scarce; among more than 128 nodes slots are shared. 0: no
  /// node sends to another, every ray goes through the host.
  std::optional<std::uint32_t> ray_credits = std::nullopt;
  /// Packets of rays that may be in flight to a node or in its backlog from all others together, on request, and that a node
  /// fills at a time. Not with ray_credits. Without either 64 among more than 128 nodes, or fewer if memory is scarce.
  std::optional<std::uint32_t> ray_slots = std::nullopt;
  /// Full packets that may wait at their sender for credits before rays overflow. By default 512, half as many with bundles,
  /// whose packets are twice as long, 128 if slots are shared, or fewer if memory is scarce. Unused without credits.
  std::optional<std::uint32_t> queue_packets = std::nullopt;
  /// Nodes start primary rays even if their own packets wait or another node's queue is long: more rays overflow.
  bool without_backpressure = false;
  /// Neighbouring regions are placed on nodes that are few hops apart in this machine. By default region i is node i's.
  std::optional<nodes::TopologyKind> topology = std::nullopt;
};

}  // namespace dmpc::dataflow
