// The interface of runners: they make the processors, call their programs, and allow inspection afterwards.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "core/base/expect.h"
#include "nodes/batching.h"
#include "nodes/computer_request.h"
#include "nodes/mailbox.h"
#include "nodes/node.h"
#include "nodes/observer.h"
#include "nodes/program.h"
#include "nodes/ranks/rank_report.h"
#include "nodes/virtual/virtual_times.h"

namespace dmpc::nodes {

/// One node or the host, for a runner. `make_program` is called once, on the calling thread, before the start, and may allocate
/// from node.memory(); the memory is sealed after it.
struct NodeSpecification {
  MemoryPlan plan;  ///< includes mailbox, credits table (Category::queues) and thread stack (Category::reserve)
  MailboxCapacity mailbox;
  std::function<std::unique_ptr<Program>(Node&)> make_program;
  /// Under chaos: memory for delayed packets (DelayedPackets::room_bytes(), in `plan` under Category::queues). 0: none is
  /// delayed.
  std::size_t held_bytes = 0;
  /// A bit for each kind of packet that a runner with a clock delivers at once, by an interrupt, even while the program is
  /// computing. Only for kinds whose receive() reads only immutable data, and changes only counters.
  std::uint32_t interrupt_kinds = 0;
  /// Packets that may wait at a sender on threads, where waking a thread costs microseconds. A model has no wake-ups.
  Batching batching = {};
};
static_assert(packet_kind_count <= 32);

/// A node's memory in addition to its program's, for its plan: waiting packets, credits for `peer_count` peers, its thread's
/// stack.
MemoryPlan memory_beside_program(const MailboxCapacity& mailbox, std::uint32_t peer_count, std::size_t held_bytes,
                                 std::size_t stack_bytes);

/// The number of processors that this process may use now, by its affinity: the default number of a pool's threads.
std::uint32_t processors_allowed();

/// Throws core::Refusal<core::UsageError> if there are fewer nodes than ranks.
void check_nodes_for(std::uint32_t node_count, std::uint32_t rank_count);
/// Checks the requested ranks: for plans.
void check_ranks(const ComputerRequest& computer);

enum class RunEnd : std::uint8_t { finished, interrupted };

/// Its text has each node's state; with several ranks all throw it. After it the runner's programs can be inspected, and their
/// reports be gathered.
struct DeadlockError : core::InternalError {
  using InternalError::InternalError;
};

/// Thread safety: one thread constructs, runs and reads. During run() no other function may be called.
class Runner {
 public:
  virtual ~Runner() = default;

  /// Returns when all programs are finished or `stop` is requested. Rethrows the first exception of a program. Throws
  /// core::InternalError with every node's describe() if nothing is in flight, no program has work, and some are not finished. At
  /// a regular end it expects that packets sent = packets received. After that it may be called again, once all programs have
  /// been given something to do: the computer then starts afresh, its clock and counters at zero, and nodes keep their data. On
  /// ranks this is allowed after all have gathered the reports of the run before.
  virtual RunEnd run(std::stop_token stop) = 0;

  /// After run(), for nodes that are here.
  virtual Node& node(std::size_t index) = 0;
  virtual Program& program(std::size_t index) = 0;
  /// Whether a node is in this process. The host is on rank 0.
  virtual bool is_here(std::size_t /*index*/) const { return true; }

  /// A node's report after the run, in bytes.
  using Report = std::function<std::string(std::size_t index)>;
  /// After run(): calls tell(index) for each node and the host where it is. Returns all reports, by index; on a rank without the
  /// host only those of its own nodes.
  virtual std::vector<std::string> gather(const Report& report) = 0;
  /// After gather(), on all ranks: returns each rank's report, by number; on ranks without the host nothing.
  virtual std::vector<RankReport> gather_ranks(const std::string& /*told*/) { return {}; }
  /// After a regular end; nothing if the runner has no virtual clock.
  virtual std::optional<VirtualReport> virtual_report() const { return std::nullopt; }
};

/// Threads and the wall clock, or, with a machine, a model and virtual time. `specifications`: the nodes in order, then the host.
/// `observer`, if given, observes the run and outlives it. The ranks requested by `computer` are given, too: then only this
/// rank's nodes are made.
std::unique_ptr<Runner> make_runner(std::span<const NodeSpecification> specifications, const ComputerRequest& computer,
                                    Observer* observer = nullptr);

}  // namespace dmpc::nodes
