// The differences before and after a run between the strategies in which pixels stay on their node: a node's part of the
// database, its requests to others, and their memory. During the run they differ in their records (svm/pages/plain_records.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "core/base/refusal.h"
#include "core/picture/pixel_task.h"
#include "nodes/byte_source.h"
#include "nodes/local_memory.h"
#include "nodes/mailbox.h"
#include "nodes/node.h"
#include "nodes/observers/watching.h"
#include "svm/pages/node_program.h"
#include "svm/pages/observers/reference_log.h"

namespace dmpc::svm {

struct Plan;
struct PlanRequest;
struct Report;

/// Makes the program of node `index`; called before the start, in order, on the calling thread.
using MakeProgram = std::function<std::unique_ptr<NodeProgram>(std::uint32_t index, nodes::Node& node)>;

/// One object each, which outlives all plans; compared by address. Immutable.
class Strategy {
 public:
  Strategy() = default;
  Strategy(const Strategy&) = delete;
  Strategy& operator=(const Strategy&) = delete;
  virtual ~Strategy() = default;

  /// The option's value.
  virtual const char* name() const = 0;
  /// Whether nodes fetch pages: otherwise they have no caches, and homes of pages cannot be chosen.
  virtual bool fetches_pages() const { return false; }
  /// Whether rays of neighbouring pixels may be traced together, with or without base meshes.
  virtual bool takes_bundles(bool /*has_instances*/) const { return true; }

  // Before there is a plan.

  /// Throws core::Refusal<core::UsageError> for what it does not accept, or what is missing.
  virtual void check(const PlanRequest& /*request*/) const {}
  /// The default number of tasks in flight on a node.
  virtual std::uint32_t usual_tasks(const PlanRequest& request) const = 0;
  /// The number of pages that a node may fetch, at the node that has the fewest at home.
  virtual std::uint32_t foreign_pages_max(const PlanRequest& /*request*/) const { return 0; }
  /// The first pages, which every node holds in addition to those at home there.
  virtual std::uint32_t leading_pages(const PlanRequest& /*request*/) const { return 0; }
  /// What would help if no number of nodes works with the memory that each has.
  virtual core::Sentence advice() const;

  // For a plan in which the settings above are fixed.

  /// Packets that ask for something that one node may have in flight to one other.
  virtual std::uint32_t request_credits(const Plan& /*plan*/) const { return 0; }
  /// Adds the slots in a node's mailbox for packets about records.
  virtual void add_slots(const Plan& /*plan*/, nodes::MailboxCapacity& /*capacity*/) const {}
  /// The memory of the records of node `index`.
  virtual nodes::MemoryPlan layout(const Plan& plan, std::uint32_t index) const = 0;
  /// Calls visit(offset in bytes, bytes) for each piece of the database that the program of node `index` reads when it is made,
  /// in its order.
  using Visit = std::function<void(std::size_t offset, std::size_t bytes)>;
  virtual void for_each_piece(const Plan& plan, std::uint32_t index, const Visit& visit) const = 0;
  /// The programs, with our own grid, as maker_over() (svm/program_maker.h) makes them.
  virtual MakeProgram maker(const Plan& plan, const core::RenderSettings& settings, const nodes::ByteSource& database,
                            const nodes::Watching& watching, std::vector<ReferenceLog>* reference_logs) const = 0;

  /// After a run: throws core::InternalError if packets about records are lost.
  virtual void check_conservation(const Report& /*report*/) const {}
};

using Strategies = std::vector<const Strategy*>;

/// Pages are sent.
const Strategy* svm_strategy();
/// Every node holds the whole database; only work and film are sent.
const Strategy* replicated_strategy();

}  // namespace dmpc::svm
