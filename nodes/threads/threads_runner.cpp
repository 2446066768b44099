#include "nodes/threads/threads_runner.h"

#include <sched.h>

#include <atomic>
#include <exception>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/base/expect.h"
#include "nodes/atomics.h"
#include "nodes/awake_count.h"
#include "nodes/patience.h"
#include "nodes/processors.h"
#include "nodes/threads/clock.h"
#include "nodes/threads/held_packets.h"
#include "nodes/threads/looks.h"
#include "nodes/threads/thread.h"

namespace dmpc::nodes {
namespace {

/// Quanta that pass at a node which pauses, or only waits for packets held back to fall due, until it gives its core to others.
/// Giving it away in each would cost a time slice each where other processes want the core.
constexpr std::uint32_t quanta_per_yield = 16;

/// How the run ends. The first to say so decides.
enum class Ending : std::uint8_t { none, finished, stalled, failed, interrupted };

/// A place for the packets that chaos holds back at this node, if it does.
std::optional<HeldPackets> held_packets_of(const std::optional<Chaos>& chaos, const NodeSpecification& specification, NodeId id,
                                           LocalMemory& memory, Network& network) {
  if (!chaos || specification.held_bytes == 0) {
    return std::nullopt;
  }
  return HeldPackets(*chaos, id, memory, specification.held_bytes, network);
}

/// What all processors of a computer have in common.
struct Computer {
  std::uint32_t peer_count;
  Network& network;
  const std::optional<Chaos>& chaos;
  Observer* observer;
  const std::uint64_t& start_ns;  ///< of the run
  std::size_t core_count;         ///< 0: not known
};

/// Between a program and the network, chaos or not: tells an observer what is sent, when the program sends it.
class Telling final : public Network {
 public:
  /// `call` is the number of the program's. All outlive this.
  Telling(Observer& observer, const std::uint64_t& start_ns, const std::uint32_t& call, Network& next)
      : observer_(&observer), start_ns_(&start_ns), call_(&call), next_(&next) {}

  void deliver(NodeId target, const PacketHeader& header, std::span<const std::byte> payload) override {
    const std::uint64_t now_ns = nanoseconds(CLOCK_MONOTONIC) - *start_ns_;
    observer_->sent({.node = NodeId{header.source},
                     .peer = target,
                     .kind = header.kind,
                     .call = *call_,
                     .payload = payload,
                     .times = {.sending_ns = now_ns, .left_ns = now_ns}});
    next_->deliver(target, header, payload);
  }

 private:
  Observer* observer_;
  const std::uint64_t* start_ns_;
  const std::uint32_t* call_;
  Network* next_;
};

/// One node with all that belongs to it. On cache lines of its own, so that neighbours do not disturb each other's counters.
struct alignas(cache_line_bytes) Processor {
  Processor(const NodeSpecification& specification, NodeId id, const Computer& computer)
      : memory(specification.plan),
        mailbox(specification.mailbox, memory),
        held(held_packets_of(computer.chaos, specification, id, memory, computer.network)),
        patience(specification.patience),
        looks(looks_before_sleep(computer.peer_count, computer.core_count), computer.core_count),
        node(id, computer.peer_count, memory, way_out(computer)) {
    core::expect(specification.plan[Category::reserve] >= thread_stack_bytes_min, "a plan reserves room for the thread's stack");
    if (computer.chaos) {
      pauses.emplace(*computer.chaos, id);
    }
    program = specification.make_program(node);
    core::expect(program != nullptr, "a specification makes a program");
    memory.seal();
  }

  /// Where the program's packets go first.
  Network& way_out(const Computer& computer) {
    Network& next = held ? *held : computer.network;
    return computer.observer == nullptr ? next : telling.emplace(*computer.observer, computer.start_ns, call, next);
  }

  /// Whether this node, being slow, lets the next quantum pass.
  bool sits_out() {
    if (!pauses) {
      return false;
    }
    if (quanta_to_run == 0) {
      quanta_to_run = pauses->next_quanta() + 1;
    }
    --quanta_to_run;
    node.counters().sat_out += quanta_to_run > 0 ? 1 : 0;
    return quanta_to_run > 0;
  }

  /// Hands on the packets whose time has come; returns whether others are still held back.
  bool holds_packets() {
    if (!held) {
      return false;
    }
    held->pass_quantum();
    node.counters().held = held->count();
    return !held->empty();
  }

  /// A quantum in which chaos alone keeps the node from sleeping.
  void pass_idly() {
    if (++quanta_idle % quanta_per_yield == 0) {
      sched_yield();
    }
  }

  LocalMemory memory;
  Mailbox mailbox;
  std::optional<HeldPackets> held;
  Patience patience;
  Mailbox::Batch waiting;  ///< packets sent that may wait, in slots of their target
  NodeId waiting_for{};    ///< their target
  std::uint32_t waiting_count = 0, quanta_waited = 0;
  Looks looks;                     ///< at its mailbox before it sleeps
  std::optional<Telling> telling;  ///< if somebody looks on
  Node node;
  std::unique_ptr<Program> program;
  std::optional<ChaosPauses> pauses;
  std::uint32_t quanta_idle = 0;
  std::uint32_t call = 0;           ///< number of the program's call, if somebody looks on
  Charges charged;                  ///< until the last one's end, likewise
  std::uint32_t quanta_to_run = 0;  ///< this many quanta from now the node runs one
  Thread thread;
};

}  // namespace

/// Thread safety: deliver() and the members called from run_node() run on the nodes' threads; `ending_` and `awake_` are atomic,
/// a Processor's parts belong to its thread but for the mailbox. Everything else runs on the caller's thread while no node's
/// thread exists.
struct ThreadsRunner::Implementation final : Network {
  Implementation(std::span<const NodeSpecification> specifications, const std::optional<Chaos>& chaos, Observer* observer)
      : chaos_(chaos), observer_(observer), awake_(static_cast<std::uint32_t>(specifications.size())) {
    core::expect(!specifications.empty(), "a computer has at least the host");
    const Computer computer{static_cast<std::uint32_t>(specifications.size()),
                            *this,
                            chaos_,
                            observer_,
                            start_ns_,
                            std::thread::hardware_concurrency()};
    for (std::uint32_t i = 0; i < computer.peer_count; ++i) {
      processors_.push_back(std::make_unique<Processor>(specifications[i], NodeId{i}, computer));
    }
  }

  void deliver(NodeId target, const PacketHeader& header, std::span<const std::byte> payload) override {
    Processor& source = *processors_[header.source];
    const bool may_wait = (source.patience.kinds >> header.kind & 1U) != 0;
    // What a sender sends one target arrives in order, so nothing overtakes what waits.
    if (may_wait || (source.waiting_count > 0 && source.waiting_for == target)) {
      return add_waiting(source, target, header, payload, may_wait);
    }
    core::expect(processors_[index_of(target)]->mailbox.push(header, payload, awake_),
                 "credits leave room in the target's mailbox");
  }

  RunEnd run(std::stop_token stop) {
    core::expect(!started_, "a runner runs once");
    started_ = true;
    start_ns_ = nanoseconds(CLOCK_MONOTONIC);
    {
      const std::stop_callback on_stop(std::move(stop), [this] { end(Ending::interrupted); });
      start_threads();
      for (const auto& processor : processors_) {
        processor->thread.join();
      }
    }
    return judge();
  }

  Processor& processor(std::size_t index) { return *processors_.at(index); }

 private:
  struct Start {
    Implementation* runner;
    Processor* processor;
  };

  void add_waiting(Processor& source, NodeId target, const PacketHeader& header, std::span<const std::byte> payload,
                   bool may_wait) {
    core::expect(source.waiting_count == 0 || source.waiting_for == target, "packets that may wait have one target");
    core::expect(processors_[index_of(target)]->mailbox.add(source.waiting, header, payload),
                 "credits leave room in the target's mailbox");
    source.waiting_for = target;
    if (++source.waiting_count >= source.patience.packets || !may_wait) {
      hand_over(source);
    }
  }

  void hand_over(Processor& source) {
    processors_[index_of(source.waiting_for)]->mailbox.hand_over(source.waiting, awake_);
    source.waiting_count = source.quanta_waited = 0;
  }

  void start_threads() {
    starts_.reserve(processors_.size());
    try {
      for (const auto& processor : processors_) {
        starts_.push_back({this, processor.get()});
        processor->thread.start(processor->memory.plan()[Category::reserve], enter, &starts_.back());
      }
    } catch (const core::RoomError&) {
      fail(std::make_exception_ptr(core::RoomError(too_few_threads(starts_.size() - 1))));
    } catch (...) {
      fail(std::current_exception());
    }
  }

  std::string too_few_threads(std::size_t started) const {
    return "a computer of " + std::to_string(processors_.size() - 1) + " nodes takes " + std::to_string(processors_.size()) +
           " threads, and this one lets dmpc start but " + std::to_string(started) +
           ": ask for fewer nodes, or for a higher limit (ulimit -u, pids.max of a container)";
  }

  static void enter(void* start) {
    const Start& self = *static_cast<Start*>(start);
    self.runner->run_node(*self.processor);
  }

  void run_node(Processor& self) {
    NodeCounters& counters = self.node.counters();
    const std::uint64_t start_ns = nanoseconds(CLOCK_MONOTONIC);
    try {
      while (ending_.load(std::memory_order_acquire) == Ending::none) {  // partner: end()
        step(self);
      }
    } catch (...) {
      fail(std::current_exception());
    }
    counters.busy_ns = nanoseconds(CLOCK_THREAD_CPUTIME_ID);
    counters.wall_ns = nanoseconds(CLOCK_MONOTONIC) - start_ns;
  }

  /// Receives all that has come and works one quantum; with nothing to do, sleeps until a packet comes or the run ends. A node
  /// that holds packets back does not sleep: they are under way.
  void step(Processor& self) {
    if (self.sits_out()) {
      return self.pass_idly();
    }
    self.mailbox.drain([this, &self](const Packet& packet) {
      self.node.counters().received[packet.kind].add(packet.payload.size());
      if (observer_ != nullptr) {
        return receive_observed(self, packet);
      }
      self.program->receive(packet);
    });
    const bool has_more = work(self);
    const bool holds_packets = self.holds_packets();
    // Before it sleeps in any case, for an awake node alone keeps the others from finding that all is over.
    if (!has_more || (self.waiting_count > 0 && ++self.quanta_waited >= patience_quanta_max)) {
      hand_over(self);
    }
    if (!has_more && holds_packets) {
      self.pass_idly();
    } else if (!has_more && !packet_comes_soon(self) && !self.program->has_leftovers()) {
      sleep(self);
    }
  }

  bool work(Processor& self) {
    if (self.program->finished()) {
      return false;
    }
    ++self.node.counters().quanta;
    if (observer_ != nullptr) {
      return work_observed(self);
    }
    return self.program->work();
  }

  std::uint64_t since_start_ns() const { return nanoseconds(CLOCK_MONOTONIC) - start_ns_; }

  bool work_observed(Processor& self) {
    Span span = begin_span(self, Activity::work, 0);
    const bool has_more = self.program->work();
    end_span(self, span);
    return has_more;
  }

  void receive_observed(Processor& self, const Packet& packet) {
    Span span = begin_span(self, Activity::receive, packet.kind);
    observer_->received({.node = self.node.id(),
                         .peer = packet.source,
                         .kind = packet.kind,
                         .call = span.call,
                         .payload = packet.payload,
                         .times = {.received_ns = span.begin_ns}});
    self.program->receive(packet);
    end_span(self, span);
  }

  Span begin_span(Processor& self, Activity activity, PacketKind packet) const {
    return {.node = self.node.id(),
            .activity = activity,
            .packet = packet,
            .call = ++self.call,
            .begin_ns = since_start_ns(),
            .before = self.charged};
  }

  void end_span(Processor& self, Span& span) const {
    span.end_ns = since_start_ns();
    span.own_ns = span.end_ns - span.begin_ns;
    span.after = self.charged = self.program->charges();
    observer_->ended(span, *self.program);
  }

  static bool packet_comes_soon(Processor& self) {
    for (int look = 0; look < self.looks.allowed() && self.mailbox.is_empty(); ++look) {
      const std::uint64_t before_ns = nanoseconds(CLOCK_MONOTONIC);
      sched_yield();
      const std::uint64_t now_ns = nanoseconds(CLOCK_MONOTONIC);
      if (now_ns - before_ns > Looks::long_yield_ns) {
        self.looks.yielded_long(now_ns, nanoseconds(CLOCK_PROCESS_CPUTIME_ID));
      }
    }
    self.looks.end();
    return !self.mailbox.is_empty();
  }

  void sleep(Processor& self) {
    // The order matters: ASLEEP first, so that end() either finds it or is seen; then the count, so that zero means all ASLEEP.
    if (!self.mailbox.fall_asleep() || ending_.load(std::memory_order_acquire) != Ending::none) {
      return;
    }
    if (awake_.leave()) {
      end(all_finished(processors_) ? Ending::finished : Ending::stalled);  // every node sleeps: the programs stand still
      return;
    }
    ++self.node.counters().sleeps;
    const std::uint64_t start_ns = nanoseconds(CLOCK_MONOTONIC);
    self.mailbox.wait();
    self.node.counters().asleep_ns += nanoseconds(CLOCK_MONOTONIC) - start_ns;
  }

  void fail(std::exception_ptr failure) {
    if (!failing_.exchange(true, std::memory_order_relaxed)) {
      failure_ = std::move(failure);
      end(Ending::failed);
    }
  }

  /// Ends the run, unless something else has; every thread leaves within a quantum.
  void end(Ending ending) {
    Ending none = Ending::none;
    // Release: partner of the loads in run_node() and sleep().
    if (ending_.compare_exchange_strong(none, ending, std::memory_order_release, std::memory_order_relaxed)) {
      for (const auto& processor : processors_) {
        processor->mailbox.rouse();
      }
    }
  }

  RunEnd judge() {
    switch (ending_.load(std::memory_order_relaxed)) {
      case Ending::failed:
        std::rethrow_exception(failure_);
      case Ending::stalled:
        throw core::InternalError("all nodes sleep, nothing is under way, and the work is unfinished" +
                                  (chaos_ ? " (chaos seed " + std::to_string(chaos_->seed) + "):" : ":") + describe(processors_));
      case Ending::interrupted:
        return RunEnd::interrupted;
      default:
        expect_nothing_lost();
        return RunEnd::finished;
    }
  }

  void expect_nothing_lost() const {
    for (const auto& processor : processors_) {
      core::expect(!processor->mailbox.has_packets(), "at the end all mailboxes are empty");
      core::expect(!processor->held || processor->held->empty(), "at the end no packet is held back");
    }
    expect_all_received(processors_);
  }

  std::optional<Chaos> chaos_;
  Observer* observer_;
  std::uint64_t start_ns_ = 0;  ///< of the run; written before the threads start
  AwakeCount awake_;
  alignas(cache_line_bytes) std::atomic<Ending> ending_{Ending::none};
  std::atomic<bool> failing_{false};
  std::exception_ptr failure_;  ///< written once, before the release in end(); read after the joins
  std::vector<std::unique_ptr<Processor>> processors_;
  std::vector<Start> starts_;
  bool started_ = false;
};

ThreadsRunner::ThreadsRunner(std::span<const NodeSpecification> specifications, const std::optional<Chaos>& chaos,
                             Observer* observer)
    : implementation_(std::make_unique<Implementation>(specifications, chaos, observer)) {}
ThreadsRunner::~ThreadsRunner() = default;

RunEnd ThreadsRunner::run(std::stop_token stop) { return implementation_->run(std::move(stop)); }

Node& ThreadsRunner::node(std::size_t index) { return implementation_->processor(index).node; }
Program& ThreadsRunner::program(std::size_t index) { return *implementation_->processor(index).program; }

}  // namespace dmpc::nodes
