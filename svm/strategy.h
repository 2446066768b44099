// What tells the strategies by which pixels stay apart before and after a run: what a node has of the database, what it asks
// others for, and what that takes. While it lasts their kinds of records do (svm/pages/plain_records.h).
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

/// One object each, which outlives all plans; strategies are told apart by their addresses. Immutable.
class Strategy {
 public:
  Strategy() = default;
  Strategy(const Strategy&) = delete;
  Strategy& operator=(const Strategy&) = delete;
  virtual ~Strategy() = default;

  /// As the command line calls it.
  virtual const char* name() const = 0;
  /// Whether nodes fetch pages: else they have no caches, and pages no homes that could be chosen.
  virtual bool fetches_pages() const { return false; }
  /// Whether rays of neighbouring pixels may walk together.
  virtual bool takes_bundles() const { return true; }

  // Before there is a plan.

  /// Throws core::Refusal<core::UsageError> for what it does not take, or lacks.
  virtual void check(const PlanRequest& /*request*/) const {}
  /// Tasks under way on a node unless the user has chosen.
  virtual std::uint32_t usual_tasks(const PlanRequest& request) const = 0;
  /// Pages that a node may fetch, at the node that has the fewest at home.
  virtual std::uint32_t foreign_pages_max(const PlanRequest& /*request*/) const { return 0; }
  /// The first pages, which every node holds beside those at home there.
  virtual std::uint32_t leading_pages(const PlanRequest& /*request*/) const { return 0; }
  /// What would help where no number of nodes works with the memory that each has.
  virtual core::Sentence advice() const;

  // Of a plan, in which what comes before is settled.

  /// Packets that ask for something which one node may have under way to one other.
  virtual std::uint32_t request_credits(const Plan& /*plan*/) const { return 0; }
  /// Adds the places in a node's mailbox for packets about records.
  virtual void add_slots(const Plan& /*plan*/, nodes::MailboxCapacity& /*capacity*/) const {}
  /// What the records of node `index` take.
  virtual nodes::MemoryPlan layout(const Plan& plan, std::uint32_t index) const = 0;
  /// Calls visit(offset in bytes, bytes) for each piece of the database that the program of node `index` reads when it is made,
  /// in its order.
  using Visit = std::function<void(std::size_t offset, std::size_t bytes)>;
  virtual void for_each_piece(const Plan& plan, std::uint32_t index, const Visit& visit) const = 0;
  /// The programs, with our own grid, as maker_over() (svm/program_maker.h) makes them.
  virtual MakeProgram maker(const Plan& plan, const core::RenderSettings& settings, const nodes::ByteSource& database,
                            const nodes::Watching& watching, std::vector<ReferenceLog>* reference_logs) const = 0;

  /// Of a run that has ended: throws core::InternalError if something of what records said to each other is lost.
  virtual void check_conservation(const Report& /*report*/) const {}
};

using Strategies = std::vector<const Strategy*>;

/// Pages travel.
const Strategy* svm_strategy();
/// Every node holds the whole database; nothing travels but work and film.
const Strategy* replicated_strategy();

}  // namespace dmpc::svm
