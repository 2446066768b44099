// The node program of dataflow: rays that arrive, are traced and shaded, and leave for other regions.
//
// A quantum follows the table of flow_control.h: one ray, or one bundle of rays of a kind, is traced, from its start or entry
// until it ends or leaves the region; then rays go out one by one, as long as none of them has made a packet wait: the others
// stay in the bundle. The reasons for progress and bounded queues are given there; the sums are in plan.cpp.
//
// Primary rays are started by credit: while a packet of this node waits for one, or its queue is nearly full (flow_control.h),
// none is. A node that holds its primary rays back has no other work. It is not passive, so it keeps the token; but like a
// resting node it keeps nobody's credit. So when all nodes have come to rest or hold back, all credits are returned, and one of
// them goes on.
//
// Which node shades a hit: the owner of the cell in which the traversal proves it the nearest. If that owner has found the same
// (t, primitive) itself, it shades the hit with its own copy of the record. If not, the hit goes to its finder, which alone knows
// where the record is. In either case exactly one node shades it.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "core/database/extract.h"
#include "core/picture/pixel_task.h"
#include "core/trace/operations.h"
#include "dataflow/film_gather.h"
#include "dataflow/plan.h"
#include "dataflow/rays/gather.h"
#include "dataflow/regions/primary_run.h"
#include "dataflow/regions/regions.h"
#include "dataflow/units/movement.h"
#include "nodes/byte_source.h"
#include "nodes/node.h"
#include "nodes/observers/meter.h"
#include "nodes/pictures/computer.h"

namespace dmpc::dataflow {

/// A node's counters in addition to core's operations and the packets.
struct RayCounters {
  std::array<std::uint64_t, core::ray_kind_count> in{}, out{};  ///< rays received and sent, by kind; confirmed hits included
  std::uint64_t ended = 0;                                      ///< hits or misses; over all nodes as many as were shot
  std::uint64_t hits_sent_back = 0;                             ///< confirmed here, shaded by their finder
  std::uint64_t rests = 0;                                      ///< times that the node ran out of work
  std::uint64_t tests_avoided = 0;  ///< lanes that rays had tested on other nodes (RayOptions::tested_objects)

  std::uint64_t received() const { return std::accumulate(in.begin(), in.end(), std::uint64_t{0}); }
  std::uint64_t sent() const { return std::accumulate(out.begin(), out.end(), std::uint64_t{0}); }
};

/// A value.
struct ProgramCounts {
  core::Operations operations;
  RayCounters rays;
  Gather::Counters gather;
  FilmGather::Counters film;
  MovementCounters movement;
  std::uint32_t backlog_high_water = 0;  ///< the most rays in the backlog at once
};
static_assert(std::is_trivially_copyable_v<ProgramCounts>, "it travels as bytes to the host's rank");

/// All that a program counted.
struct ProgramReport : ProgramCounts {
  std::vector<SentToOwner> pairs;  ///< by owner, ascending; owners without rays are left out
};

/// The base of all node programs of dataflow, with any kind of regions.
class NodeProgram : public nodes::Program, public pictures::PictureProgram {
 public:
  /// The memory of the plan's program at node `index`.
  static nodes::MemoryPlan layout(const Plan& plan, std::uint32_t index);
  /// Call it only while the program is not running.
  virtual ProgramReport report() const = 0;
};

/// A node's assignment, read in the constructor of its program only.
struct NodeAssignment {
  const core::DatabaseHeader& header;  ///< its part's
  nodes::ByteSource records;           ///< the records of the part
  std::span<const PrimaryRun> primaries;
  const core::RenderSettings& settings;  ///< the whole picture's
  const Regions& regions;
  const core::DatabasePart& proxy;                   ///< the whole database's
  std::span<const std::uint32_t> pages = {};         ///< if regions move: the numbers of the part's pages
  std::span<const std::uint32_t> runs_of_unit = {};  ///< if regions move: the number of runs of each unit, in turn
};

/// The program of the plan.
std::unique_ptr<NodeProgram> make_node_program(nodes::Node& node, const Plan& plan, const NodeAssignment& assign,
                                               const std::optional<nodes::Meter>& meter = std::nullopt);

}  // namespace dmpc::dataflow
