// What a run needs, in bytes, slots and credits, known before anything is allocated: fits, or says what would.
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

/// What one node is assigned, as far as the memory asks.
struct Share {
  std::size_t part_bytes = 0;    ///< its part of the database, records alone
  std::size_t primary_runs = 0;  ///< entries of its list of primary rays
  std::size_t proxy_bytes = 0;   ///< of the whole database's proxy, with what may be read behind it
  std::size_t page_bytes = 0;    ///< where regions move: the size of the pages that the part consists of
};

/// What a plan is made from. `optional` without a value means: choose.
struct PlanRequest {
  std::vector<Share> shares;             ///< one a node: from 1 to nodes::node_count_max
  nodes::ComputerRequest computer = {};  ///< its nodes are as many as the shares, whatever it says
  RayOptions rays = {};
  std::uint32_t depth_max = 5;         ///< of a ray
  std::uint32_t waiting_hits_max = 5;  ///< entries of a task's stack
  std::uint32_t width = 0, height = 0;
  std::uint32_t first_samples = 1;  ///< of each pixel in the first pass
  core::RefinementOptions refinement;
  bool is_assigned_on_the_way = false;  ///< the host assigns the primary rays of the first pass as nodes have room for them
  bool bundles = false;                 ///< rays walk together, where the memory has room for that
  bool has_instances = false;           ///< of the database: rays have longer cursors
  std::uint32_t node_count() const { return static_cast<std::uint32_t>(shares.size()); }
  /// Regions are units that nodes migrate.
  bool is_moving() const { return !shares.empty() && shares.front().page_bytes > 0; }
  /// The host assigns primary rays after the start, for which nodes have room.
  bool is_assigned() const { return is_assigned_on_the_way || refinement.is_wanted(); }
  /// In which primary rays start: on modelled machines as on those of the article, row by row.
  PixelOrder pixel_order() const { return computer.machine ? PixelOrder() : PixelOrder::squares(width, height); }
};

inline constexpr std::uint32_t ray_credits_max = 64;
inline constexpr std::uint32_t ray_slots_max = 4096;
inline constexpr std::uint32_t queue_packets_max = 16384;

/// The answer. Every capacity is derived in plan.cpp, as a sum with a comment for each term.
struct Plan {
  PlanRequest request;
  std::uint32_t ray_batch = 1;      ///< rays in a full packet
  std::uint32_t ray_credits = 1;    ///< from each node for each other, without asking
  std::uint32_t ray_slots = 0;      ///< of each node, that the others share and ask for; 0: they have credits of their own
  std::uint32_t host_credits = 1;   ///< packets of rays from each node for the host, and from the host for each node
  std::uint32_t queue_packets = 0;  ///< full packets that may wait at their sender for credits
  std::uint32_t rays_a_task = 1;    ///< rays that a node traces at a time, at most: more than one where they walk in bundles
  std::uint32_t film_credits = 1;   ///< film packets from each node for the host
  std::uint32_t spare_frames = 0;   ///< pages of units that a node has room to take
  std::size_t held_bytes = 0;       ///< room at each node and the host for packets that chaos holds back
  nodes::MailboxCapacity node_mailbox, host_mailbox;
  std::vector<std::string> notes;  ///< sentences to print, such as what was reduced

  std::uint32_t node_count() const { return request.node_count(); }
  nodes::NodeId host() const { return nodes::NodeId{node_count()}; }
  bool shares_slots() const { return ray_slots > 0; }
  /// What a node gathers rays in.
  Gather::Capacity gather() const;
  /// Names of tested blocks that a ray takes along.
  std::uint32_t tested_objects() const { return request.rays.tested_objects; }
  /// A full packet of rays.
  std::size_t packet_bytes() const { return ray_packet_bytes(ray_batch, tested_objects()); }

  /// Of a full packet of film. Where rays walk together it is as long as one of rays, since each packet parts the pixels of a
  /// bundle, whose later light then takes entries of its own; but a node sends some before the end, also of a small picture.
  std::uint32_t film_entries() const;
  /// What a node gathers light in, of which so many deposits may come at once.
  FilmGather::Capacity film(std::uint32_t at_once) const { return {node_count(), film_credits, film_entries(), at_once}; }

  bool is_moving() const { return request.is_moving(); }
  /// Units in all, if regions move.
  std::uint32_t unit_count() const { return is_moving() ? node_count() * request.rays.balance.regions_a_node : 0; }
  /// A page of a unit with its header takes so much.
  std::size_t unit_packet_bytes() const;
  /// The primary rays that node `index` has room for by unit: a node that takes a unit may have had fewer of its own than the
  /// mean. Requires that regions move, here and below.
  UnitPrimaries::Capacity primaries_of_node(std::uint32_t index) const;
  /// The pages that node `index` has room for.
  UnitPages::Capacity pages_of_node(std::uint32_t index) const;

  /// Packets of primary rays that the host may have under way to each node.
  std::uint32_t dealing_credits() const;

  /// Exactly what node `index` takes, by category.
  nodes::MemoryPlan node_memory(std::uint32_t index) const;
  /// The node that takes most.
  std::uint32_t largest_node() const;
  /// The most that any node takes.
  std::size_t node_memory_max_bytes() const { return node_memory(largest_node()).total(); }
  /// Except for the rays that overflow, which grow as they come (Report says how far), and those of later passes not yet assigned.
  nodes::MemoryPlan host_memory() const;
};

/// The smallest number of nodes above the request's that works with the request's memory, if there is one.
using OtherNodeCount = std::function<std::optional<std::uint32_t>()>;

/// Throws core::Refusal<core::UsageError> for a value out of range, of core::CapacityError if the memory is too small: naming the
/// node that needs most, what it needs, the smallest node memory that works for this node count, and the node count that
/// `other_node_count` finds (asked in this case only).
Plan make_plan(const PlanRequest& request, const OtherNodeCount& other_node_count = {});

/// The smallest node memory with which make_plan(request) succeeds, whatever request.node_memory_bytes says.
std::size_t smallest_node_memory_bytes(const PlanRequest& request);

}  // namespace dmpc::dataflow
