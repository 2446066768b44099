// What a run with rays that travel may choose: options, runs and plans have it as a member.
#pragma once

#include <cstdint>
#include <optional>

#include "dataflow/regions/balance.h"
#include "nodes/topology.h"

namespace dmpc::dataflow {

/// `optional` without a value means: choose.
struct RayOptions {
  BalanceOptions balance = {};  ///< how the regions are cut
  /// Rays in a full packet. Without it what fills a packet of 4 KiB, or of 2 KiB where rays walk alone, of 1 KiB on a modelled
  /// machine, or fewer if the memory is scarce.
  std::optional<std::uint32_t> ray_batch = std::nullopt;
  /// Names of blocks that a ray has tested and takes along, so that they are not tested again where they reach into other
  /// regions; 4 bytes each lengthen its message. With any, rays walk alone.
  std::uint32_t tested_objects = 0;
  /// Packets of rays that may be under way, or in the receiver's backlog, for each sender and receiver. Without it 4, with
  /// bundles up to 64 among fewer than 16 nodes, or fewer if the memory is scarce; among more than 128 nodes places are shared.
  /// 0: no node sends to another, every ray goes by way of the host.
  std::optional<std::uint32_t> ray_credits = std::nullopt;
  /// Packets of rays that may be under way to a node or in its backlog from all others together, who ask for places, and that a
  /// node fills at a time. Not with ray_credits. Without either 64 among more than 128 nodes, or fewer if the memory is scarce.
  std::optional<std::uint32_t> ray_slots = std::nullopt;
  /// Full packets that may wait at their sender for credits before rays overflow. Without it 512, half as many of bundles, whose
  /// packets are twice as long, 128 where places are shared, or fewer if the memory is scarce. Of no use without credits.
  std::optional<std::uint32_t> queue_packets = std::nullopt;
  /// Nodes start primary rays whatever waits, their own packets or those of another whose queue is long: more rays overflow.
  bool without_backpressure = false;
  /// Neighbouring regions are put on nodes that are few hops apart in this machine. Without it region i is node i's.
  std::optional<nodes::TopologyKind> topology = std::nullopt;
};

}  // namespace dmpc::dataflow
