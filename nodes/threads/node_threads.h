// The nodes of this process, each on its own thread or several per worker thread: all of a computer's, or a rank's share.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "nodes/awake_count.h"
#include "nodes/chaos.h"
#include "nodes/mailbox.h"
#include "nodes/node.h"
#include "nodes/observer.h"
#include "nodes/runner.h"
#include "nodes/threads/thread_processor.h"
#include "nodes/threads/worker_thread.h"

namespace dmpc::nodes {

/// How a run ends, the gravest last. The first one in a process decides.
enum class Ending : std::uint8_t { none, finished, interrupted, stalled, failed };

/// Transports packets from and to other processes.
class Carrier {
 public:
  /// Transports what there is, unless another thread does so; called by awake nodes' threads between quanta. Never blocks.
  virtual void carry() = 0;

 protected:
  ~Carrier() = default;
};

/// For a computer that has nodes in other processes, too.
struct Outlet {
  std::vector<bool> is_here;  ///< by node, the host last
  /// The mailbox for packets to nodes elsewhere, each after its target's index (4 bytes).
  Mailbox& outbox;
  Mailbox& call;  ///< its receiver is roused when all nodes here sleep, and at the end
  Carrier& carrier;
};

/// The text on a deadlock, before a line for each program.
std::string deadlock_text(const std::optional<Chaos>& chaos);

/// Thread safety: deliver() and what threads run belongs to the nodes' threads; end(), fail() and ending() may be called from
/// any. Functions of the bringer are called by one thread at a time, a node's or another; everything else by the thread that
/// makes this, while no node's thread exists.
class NodeThreads final : public Network {
 public:
  /// Makes the programs of the nodes that are here; without an outlet those of all. `observer`, if given, is called on the nodes'
  /// threads; it and the outlet outlive this. `pool_threads` and `immutable`: as in ComputerRequest; with chaos or an outlet
  /// immutable bytes are copied.
  NodeThreads(std::span<const NodeSpecification> specifications, const std::optional<Chaos>& chaos, Observer* observer,
              const Outlet* outlet = nullptr, const std::optional<std::uint32_t>& pool_threads = std::nullopt,
              Immutable immutable = Immutable::is_copied);
  ~NodeThreads() override;

  void deliver(NodeId target, const PacketHeader& header, std::span<const std::byte> payload) override;
  bool deliver_in_place(NodeId target, const PacketHeader& header, std::span<const std::byte> front,
                        std::span<const std::byte> immutable) override;

  /// Starts the threads; if one cannot start that is a failure. `start_ns`: the start of the run, by CLOCK_MONOTONIC.
  void start(std::uint64_t start_ns);
  /// After a regular end, and join(): all nodes are awake again, and start() begins another run, counted from zero.
  void begin_again();
  /// Waits until all have left.
  void join();

  /// Ends the run, unless it has ended; every thread leaves within a quantum. Without an outlet it ends by itself when all nodes
  /// sleep.
  void end(Ending ending);
  /// Ends it with this failure, unless there is one already.
  void fail(std::exception_ptr failure);
  Ending ending() const { return ending_.load(std::memory_order_acquire); }  // partner: end()
  /// What the run failed with; after join().
  const std::exception_ptr& failure() const { return failure_; }

  /// For the bringer: as long as it lives, packets may be brought.
  class Bringing {
   public:
    explicit Bringing(NodeThreads& nodes) : nodes_(&nodes) { nodes_->awake_.raise(); }
    Bringing(const Bringing&) = delete;
    Bringing& operator=(const Bringing&) = delete;
    ~Bringing() { static_cast<void>(nodes_->awake_.leave()); }
    /// Puts a packet into the mailbox of its target, which is here, and has a slot by its sender's credit.
    void bring(NodeId target, const PacketHeader& header, std::span<const std::byte> payload);

   private:
    NodeThreads* nodes_;
  };
  /// For a bringer that is no node: whether all nodes here sleep, and will until a packet is brought. If so, their programs'
  /// describe() may be called.
  bool all_sleep() const { return awake_.is_zero(); }
  std::uint32_t unfinished_count() const;
  /// A line for each program that is here.
  std::string describe() const;

  /// Expects that no packet lies in a mailbox or is delayed; after a regular end.
  void expect_nothing_lies_about() const;

  const std::vector<std::unique_ptr<ThreadProcessor>>& processors() const { return processors_; }
  /// Expects that it is here.
  ThreadProcessor& processor(std::size_t index) const;
  bool is_here(std::size_t index) const { return by_index_.at(index) != nullptr; }

 private:
  struct Start {
    NodeThreads* nodes;
    ThreadProcessor* processor;
    WorkerThread* worker_thread;  ///< or this one
  };
  /// What a node does after a quantum.
  enum class Next : std::uint8_t {
    go_on,
    pass,  ///< only chaos keeps it from sleeping
    rest   ///< it has nothing to do
  };

  Mailbox& mailbox_towards(NodeId target) const;
  void add_waiting(ThreadProcessor& source, NodeId target, const PacketHeader& header, std::span<const std::byte> payload,
                   std::span<const std::byte> front, bool may_wait);
  void hand_over(ThreadProcessor& source);
  AwakeCount& count_towards(NodeId target) { return by_index_[index_of(target)] != nullptr ? awake_ : uncounted_; }
  void make_worker_threads(std::size_t count);
  void start_threads();
  std::string too_few_threads(std::size_t started) const;
  static void enter(void* start);
  void run_node(ThreadProcessor& self);
  void run_worker_thread(WorkerThread& worker_thread);
  void take_turn(WorkerThread& worker_thread, std::uint32_t number);
  static bool falls_asleep(ThreadProcessor& self);
  Next step(ThreadProcessor& self);
  bool work(ThreadProcessor& self);
  std::uint64_t since_start_ns() const;
  bool work_observed(ThreadProcessor& self);
  void receive_observed(ThreadProcessor& self, const Packet& packet);
  void end_wait(ThreadProcessor& self, const Packet& packet, std::uint64_t end_ns) const;
  Span begin_span(ThreadProcessor& self, Activity activity, PacketKind packet) const;
  void end_span(ThreadProcessor& self, Span& span) const;
  void rest(ThreadProcessor& self);
  void sleep(WorkerThread& worker_thread);
  bool go_to_sleep(Mailbox& inbox);
  bool has_to_send() const { return outlet_ != nullptr && !outlet_->outbox.is_empty(); }
  void carry() const;

  std::optional<Chaos> chaos_;
  Observer* observer_;
  const Outlet* outlet_;
  Immutable immutable_;
  std::uint64_t start_ns_ = 0;  ///< start of the run; written before the threads start
  AwakeCount awake_;            ///< nodes or worker threads, and the bringer while it brings
  AwakeCount uncounted_;        ///< for the outbox, whose receiver is no node: never read
  alignas(cache_line_bytes) std::atomic<Ending> ending_{Ending::none};
  std::atomic<bool> failing_{false};
  std::exception_ptr failure_;                                ///< written once, before the release in end(); read after the joins
  std::vector<std::unique_ptr<ThreadProcessor>> processors_;  ///< nodes that are here
  std::vector<ThreadProcessor*> by_index_;                    ///< all nodes; nullptr if elsewhere
  std::vector<std::unique_ptr<WorkerThread>> worker_threads_;  ///< none where each node has a thread
  std::vector<Start> starts_;
};

}  // namespace dmpc::nodes
