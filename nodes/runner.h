// What every runner offers: it makes the processors, calls their programs, and lets one look at them afterwards.
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

/// One node or the host as a runner needs it. `make_program` is called once, on the calling thread, before the start, and may
/// allocate from node.memory(); the memory is sealed after it.
struct NodeSpecification {
  MemoryPlan plan;  ///< includes mailbox, credits table (Category::queues) and thread stack (Category::reserve)
  MailboxCapacity mailbox;
  std::function<std::unique_ptr<Program>(Node&)> make_program;
  /// Under chaos: room for packets held back (DelayedPackets::room_bytes(), in `plan` under Category::queues). 0: none is held
  /// back.
  std::size_t held_bytes = 0;
  /// A bit for each kind of packet that a runner with a clock delivers at once, by an interrupt, whatever the program is
  /// computing. Only for kinds whose receive() reads nothing but what never changes, and changes nothing but counters.
  std::uint32_t interrupt_kinds = 0;
  /// What may wait at a sender on threads, where waking one costs microseconds. A model knows no wake-ups.
  Batching batching = {};
};
static_assert(packet_kind_count <= 32);

/// What a node takes beside its program, for its plan: where packets wait, credits for `peer_count` peers, its thread's stack.
MemoryPlan memory_beside_program(const MailboxCapacity& mailbox, std::uint32_t peer_count, std::size_t held_bytes,
                                 std::size_t stack_bytes);

/// Processors that this process may run on now, by its affinity: what a pool has threads for unless it is told.
std::uint32_t processors_allowed();

/// Throws core::Refusal<core::UsageError> if there are fewer nodes than ranks.
void check_nodes_for(std::uint32_t node_count, std::uint32_t rank_count);
/// Checks the ranks that are asked for: for plans.
void check_ranks(const ComputerRequest& computer);

enum class RunEnd : std::uint8_t { finished, interrupted };

/// Has what each node says of itself; of several ranks all have it. After it a runner's programs can be looked at, and what they
/// say be gathered.
struct DeadlockError : core::InternalError {
  using InternalError::InternalError;
};

/// Thread safety: one thread constructs, runs and reads. While run() is going nothing else may be called.
class Runner {
 public:
  virtual ~Runner() = default;

  /// Returns when all programs are finished or `stop` is requested. Rethrows the first exception of a program. Throws
  /// core::InternalError with every node's describe() if nothing is under way, no program has work, and some are not finished.
  /// At a regular end it expects that packets sent = packets received. After one it may be called again, where all programs have
  /// been given something to do: the computer is then as new, its clock and counters at zero, and nodes have what they had. On
  /// ranks when all have gathered what the one before has left to tell.
  virtual RunEnd run(std::stop_token stop) = 0;

  /// After run(), of those that are here.
  virtual Node& node(std::size_t index) = 0;
  virtual Program& program(std::size_t index) = 0;
  /// Whether a node is in this process. The host is on rank 0.
  virtual bool is_here(std::size_t /*index*/) const { return true; }

  /// What a node has to say when it is over, in bytes.
  using Report = std::function<std::string(std::size_t index)>;
  /// After run(): calls tell(index) for each node and the host where it is. What all have said, by index; on a rank that is not
  /// the host's, only what was said there.
  virtual std::vector<std::string> gather(const Report& report) = 0;
  /// After gather(), where there are ranks, on all of them: what each has to say of itself, by number; on those without the host
  /// nothing.
  virtual std::vector<RankReport> gather_ranks(const std::string& /*told*/) { return {}; }
  /// After a regular end; nothing from a runner without a clock of its own.
  virtual std::optional<VirtualReport> virtual_report() const { return std::nullopt; }
};

/// Threads and the wall clock, or, with a machine, a model and virtual time. `specifications`: the nodes in order, then the host,
/// last. `observer`, if given, looks on, and outlives the run.
/// The ranks that `computer` asks for are given, too: then this rank's nodes alone are made.
std::unique_ptr<Runner> make_runner(std::span<const NodeSpecification> specifications, const ComputerRequest& computer,
                                    Observer* observer = nullptr);

}  // namespace dmpc::nodes
