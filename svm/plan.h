// The resources of a run, in bytes, slots and credits, computed before anything is allocated: fits, or reports what would.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/refusal.h"
#include "core/picture/film/partial_picture.h"
#include "core/picture/sampling/refinement.h"
#include "nodes/batching.h"
#include "nodes/computer_request.h"
#include "nodes/local_memory.h"
#include "nodes/mailbox.h"
#include "svm/film_gather.h"
#include "svm/page_options.h"
#include "svm/pages/page.h"
#include "svm/pages/page_capacity.h"
#include "svm/strategy.h"
#include "svm/work_source.h"

namespace dmpc::svm {

/// Whether the strategy uses this field of PageOptions: some are only for nodes that fetch pages.
bool goes_with(const core::Field& field, const Strategy& strategy);

/// The arguments of a plan. `optional` without a value means: choose.
struct PlanRequest {
  const Strategy* strategy = svm_strategy();
  std::uint32_t page_count = 0;
  std::uint32_t forest_page_count = 0;  ///< number before the first subtree (core::Database::forest_page_count())
  std::uint32_t open_page_count = 0;    ///< number after them (core::Database::open_page_count())
  std::size_t page_size_bytes = 1024;
  nodes::ComputerRequest computer = {};  ///< without a memory limit, svm's caches have a quarter of the database each, at least
                                         ///< 64 pages and at most all pages that are not at home
  PageOptions pages = {};
  int waiting_hits_max = 5;  ///< entries of a pixel's ray stack
  std::uint32_t width = 0, height = 0;
  std::uint32_t first_samples = 1;  ///< per pixel in the first pass
  core::RefinementOptions refinement;
  core::FilmScale film_scale;                   ///< the film's, which the host has
  const core::PartialPicture* start = nullptr;  ///< what is done already, if anything; outlives plan and run. Its light is the
                                                ///< host's: without that there may be none
  std::span<const std::byte> database = {};     ///< its bytes, if the host is home to all pages; outlive the making of programs
  const core::FineDetail* detail = nullptr;  ///< the picture's, if it is refined; used by the host alone; outlives plan and run
  bool bundles = false;                      ///< rays of neighbouring pixels are traced together, where enough are in flight
  bool has_instances = false;                ///< the database's: rays have longer cursors

  /// Number of nodes that render.
  std::uint32_t worker_count() const { return pages.worker_count.value_or(computer.node_count); }
  /// Whether some pass may leave pixels out, so that each node keeps a byte for each pixel of its share.
  bool is_masked() const { return refinement.is_wanted() || start != nullptr; }
  /// Whether the host assigns the work.
  bool is_assigned() const { return pages.work_donor == WorkDonor::host; }
};

/// A plan. Every capacity is derived in plan.cpp, as a sum with a comment for each term.
struct Plan {
  PlanRequest request;
  std::uint32_t frames = 0;          ///< per node's cache
  std::uint32_t resident_count = 0;  ///< pages that every node keeps permanently in addition to those at home, in separate frames
  std::vector<PageId> resident = {};   ///< which: as many, once the run has found them
  OwnPolicyRun* own_policy = nullptr;  ///< the caches of request.pages.own_policy, once the run has started it
  std::uint32_t in_flight = 1;         ///< pixels in flight, after reduction; no more than a node ever has
  std::uint32_t pixels_a_task = 1;     ///< at most: more than one if their rays are traced in bundles
  std::uint32_t worker_count = 1;      ///< nodes that render
  std::uint32_t work_item_side = 0;    ///< pixels; 0: no node gives work to another
  std::uint32_t request_credits = 0;   ///< packets that ask for something that one node may have in flight to one other
  std::uint32_t film_credits = 0;      ///< film packets that one node may have in flight to the host
  std::uint32_t film_entries = 0;      ///< per full film packet
  std::uint32_t film_planes = 2;       ///< on which an entry has light
  std::size_t held_bytes = 0;          ///< memory at each node and the host for packets delayed by chaos
  nodes::MailboxCapacity node_mailbox, host_mailbox;
  std::vector<std::string> notes;  ///< messages to print, such as what was reduced

  std::uint32_t node_count() const { return request.computer.node_count; }
  /// The exact memory of node `index`, by category. Home pages differ by at most one page between nodes.
  nodes::MemoryPlan node_memory(std::uint32_t index) const;
  /// The largest memory of a node.
  std::size_t node_memory_max_bytes() const;
  nodes::MemoryPlan host_memory() const;

  /// The capacities of the parts.
  PageCapacity pages() const;
  FilmCapacity film() const;
  WorkShape work() const;
  /// Packets that need not wake their target each.
  nodes::Batching batching() const;

  /// Number of tasks on a node: a task waits for one page at a time.
  std::uint32_t task_count() const { return in_flight / pixels_a_task; }
  /// Maximum number of faults at a node: a fault has at least one task in flight, a task waits for one page, and a page that is
  /// not at home has at most one fault.
  std::uint32_t faults_max() const;
};

/// Throws core::Refusal<core::UsageError> for a value out of range or a wrong combination, of core::CapacityError if the memory
/// is too small; the latter names the smallest node memory that works for this node count and, if there is one up to
/// nodes::node_count_max, the smallest node count that works with this memory.
Plan make_plan(const PlanRequest& request);

/// The smallest node memory with which make_plan(request) succeeds, regardless of request.node_memory_bytes.
std::size_t smallest_node_memory_bytes(const PlanRequest& request);

}  // namespace dmpc::svm
