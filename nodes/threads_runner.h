// Runs the node programs on one thread a node, wall clock; an idle node sleeps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>

#include "nodes/chaos.h"
#include "nodes/mailbox.h"
#include "nodes/node.h"
#include "nodes/program.h"

namespace dmpc::nodes {

/// The least thread stack that a plan may reserve (Category::reserve), in bytes. Sanitizers get a larger one, outside the plan.
inline constexpr std::size_t thread_stack_bytes_min = std::size_t{64} << 10U;

/// One node or the host as the runner needs it. `make_program` is called once, on the calling thread, before the start, and may
/// allocate from node.memory(); the memory is sealed after it.
struct NodeSpecification {
  MemoryPlan plan;  ///< includes mailbox, credits table (Category::queues) and thread stack (Category::reserve)
  MailboxCapacity mailbox;
  std::function<std::unique_ptr<Program>(Node&)> make_program;
  /// Under chaos: room for packets held back (HeldPackets::room_bytes(), in `plan` under Category::queues). 0: none is held back.
  std::size_t held_bytes = 0;
};

/// The bytes that a Node's own table of credits takes of Category::queues.
std::size_t credit_table_bytes(std::uint32_t peer_count);

enum class RunEnd : std::uint8_t { finished, interrupted };

/// Thread safety: one thread constructs, runs and reads. While run() is going nothing else may be called.
class ThreadsRunner {
 public:
  /// `specifications`: the nodes in order, then the host, last. With `chaos` the computer delays and reorders packets, and some
  /// of its nodes are slow; the credits are the strategy's to shrink (shrunk_credits()).
  explicit ThreadsRunner(std::span<const NodeSpecification> specifications, const std::optional<Chaos>& chaos = std::nullopt);
  ~ThreadsRunner();

  /// Starts a thread for each, returns when all programs are finished or `stop` is requested (then every thread has ended within
  /// a quantum). Rethrows the first exception of a program. Throws core::InternalError with every node's describe() if all nodes
  /// sleep, nothing is under way and the work is unfinished (exact, no time-out). At a regular end it expects that packets sent =
  /// packets received.
  RunEnd run(std::stop_token stop);

  /// After run().
  Node& node(std::size_t index);
  Program& program(std::size_t index);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace dmpc::nodes
