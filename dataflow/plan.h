// The resources of a run, in bytes, slots and credits, computed before anything is allocated: fits, or reports what would.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/picture/sampling/refinement.h"
#include "dataflow/film_gather.h"
#include "dataflow/packets.h"
#include "dataflow/ray_options.h"
#include "dataflow/rays/gather.h"
#include "dataflow/rays/pixel_order.h"
#include "dataflow/regions/regions.h"
#include "dataflow/units/unit_pages.h"
#include "dataflow/units/unit_primaries.h"
#include "nodes/computer_request.h"
#include "nodes/local_memory.h"
#include "nodes/runner.h"

namespace dmpc::dataflow {

/// The sizes of one node's assignment.
struct Share {
  std::size_t part_bytes = 0;    ///< its part of the database, records only
  std::size_t primary_runs = 0;  ///< entries of its list of primary rays
  std::size_t proxy_bytes = 0;   ///< the whole database's proxy, including readable bytes behind it
  std::size_t page_bytes = 0;    ///< if regions move: the size of the pages of which the part consists
};

/// The arguments of a plan. `optional` without a value means: choose.
struct PlanRequest {
  std::vector<Share> shares;             ///< its number of nodes is ignored: it is that of the shares
  nodes::ComputerRequest computer = {};  ///< its number of nodes is ignored: it is that of the shares
  RayOptions rays = {};
  std::uint32_t depth_max = 5;         ///< maximum of a ray's depth
  std::uint32_t waiting_hits_max = 5;  ///< entries of a task's stack
  std::uint32_t width = 0, height = 0;
  std::uint32_t first_samples = 1;  ///< per pixel in the first pass
  core::RefinementOptions refinement;
  bool is_assigned_on_the_way = false;  ///< the host assigns the primary rays of the first pass as nodes have slots for them
  bool bundles = false;                 ///< rays are traced in bundles, if there is enough memory
  bool has_instances = false;           ///< the database's: rays have longer cursors
  std::uint32_t node_count() const { return static_cast<std::uint32_t>(shares.size()); }
  /// Whether regions are units that nodes migrate.
  bool is_moving() const { return !shares.empty() && shares.front().page_bytes > 0; }
  /// Whether the host assigns primary rays after the start, for which nodes have memory.
  bool is_assigned() const { return is_assigned_on_the_way || refinement.is_wanted(); }
  /// The order in which primary rays start: on modelled machines, as in the article, row by row.
  PixelOrder pixel_order() const { return computer.machine ? PixelOrder() : PixelOrder::squares(width, height); }
};

inline constexpr std::uint32_t ray_credits_max = 64;
inline constexpr std::uint32_t ray_slots_max = 4096;
inline constexpr std::uint32_t queue_packets_max = 16384;

/// A plan. Every capacity is derived in plan.cpp, as a sum with a comment for each term.
struct Plan {
  PlanRequest request;
  std::uint32_t ray_batch = 1;      ///< rays in a full packet
  std::uint32_t ray_credits = 1;    ///< from each node for each other, without asking
  std::uint32_t ray_slots = 0;      ///< at each node, shared by the others and granted on request; 0: credits for each
  std::uint32_t host_credits = 1;   ///< packets of rays from each node for the host, and from the host for each node
  std::uint32_t queue_packets = 0;  ///< full packets that may wait at their sender for credits
  std::uint32_t rays_a_task = 1;    ///< maximum number of rays that a node traces at a time: more than one in bundles
  std::uint32_t film_credits = 1;   ///< film packets from each node for the host
  std::uint32_t spare_frames = 0;   ///< additional pages of units for which a node has memory
  std::size_t held_bytes = 0;       ///< memory at each node and the host for packets delayed by chaos
  nodes::MailboxCapacity node_mailbox, host_mailbox;
  std::vector<std::string> notes;  ///< messages to print, such as what was reduced

  std::uint32_t node_count() const { return request.node_count(); }
  nodes::NodeId host() const { return nodes::NodeId{node_count()}; }
  bool shares_slots() const { return ray_slots > 0; }
  /// The capacities of a node's gather.
  Gather::Capacity gather() const;
  /// The number of names of tested leaves in a ray.
  std::uint32_t tested_objects() const { return request.rays.tested_objects; }
  /// The size of a full packet of rays.
  std::size_t packet_bytes() const { return ray_packet_bytes(ray_batch, tested_objects()); }

  /// The capacities of a node's film gather, which may get `at_once` deposits at a time.
  FilmGather::Capacity film(std::uint32_t at_once) const { return {node_count(), film_credits, film_packet_entries, at_once}; }

  bool is_moving() const { return request.is_moving(); }
  /// The number of units, if regions move.
  std::uint32_t unit_count() const { return is_moving() ? node_count() * request.rays.balance.regions_a_node : 0; }
  /// The size of a unit's page with its header.
  std::size_t unit_packet_bytes() const;
  /// A node's capacity for primary rays by unit: a node that takes a unit may have had fewer of its own than the mean. Requires
  /// that regions move, also below.
  UnitPrimaries::Capacity primaries_of_node(std::uint32_t index) const;
  /// The capacity of node `index` for pages.
  UnitPages::Capacity pages_of_node(std::uint32_t index) const;

  /// Packets of primary rays that the host may have in flight to each node.
  std::uint32_t dealing_credits() const;

  /// The exact memory of node `index`, by category.
  nodes::MemoryPlan node_memory(std::uint32_t index) const;
  /// The node that needs most memory.
  std::uint32_t largest_node() const;
  /// The largest memory of a node.
  std::size_t node_memory_max_bytes() const { return node_memory(largest_node()).total(); }
  /// Without the rays that overflow, which grow as they come (Report has the maximum), and those of later passes not yet
  /// assigned.
  nodes::MemoryPlan host_memory() const;
};

/// The smallest number of nodes above the request's that works with the request's memory, if there is one.
using OtherNodeCount = std::function<std::optional<std::uint32_t>()>;

/// Throws core::Refusal<core::UsageError> for a value out of range, of core::CapacityError if the memory is too small: naming the
/// node that needs most, its memory, the smallest node memory that works for this node count, and the node count that
/// `other_node_count` finds (called only in this case).
Plan make_plan(const PlanRequest& request, const OtherNodeCount& other_node_count = {});

/// The smallest node memory with which make_plan(request) succeeds, regardless of request.node_memory_bytes.
std::size_t smallest_node_memory_bytes(const PlanRequest& request);

}  // namespace dmpc::dataflow
