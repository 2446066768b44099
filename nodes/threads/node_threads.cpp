#include "nodes/threads/node_threads.h"

#include <sched.h>

#include <algorithm>
#include <thread>
#include <utility>

#include "core/base/expect.h"
#include "core/base/usual_arithmetic.h"
#include "nodes/processors.h"
#include "nodes/threads/clock.h"

namespace dmpc::nodes {
namespace {

bool packet_comes_soon(ThreadProcessor& self) {
  for (int look = 0; look < self.polls.allowed() && self.mailbox.is_empty(); ++look) {
    const std::uint64_t before_ns = nanoseconds(CLOCK_MONOTONIC);
    sched_yield();
    const std::uint64_t now_ns = nanoseconds(CLOCK_MONOTONIC);
    if (now_ns - before_ns > PollBackoff::long_yield_ns) {
      self.polls.yielded_long(now_ns, nanoseconds(CLOCK_PROCESS_CPUTIME_ID));
    }
  }
  self.polls.end();
  return !self.mailbox.is_empty();
}

/// Quanta, each some tens of microseconds, between a node's polls for packets from other processes.
constexpr std::uint64_t quanta_per_look = 16;
/// The carrier's stack use, which no node's plan knows: reserved, and hardly ever written.
constexpr std::size_t carrier_stack_bytes = std::size_t{256} << 10U;

bool is_here(const Outlet* outlet, std::size_t index) { return outlet == nullptr || outlet->is_here[index]; }

std::size_t count_here(const Outlet* outlet, std::size_t peer_count) {
  if (outlet == nullptr) {
    return peer_count;
  }
  return static_cast<std::size_t>(std::count(outlet->is_here.begin(), outlet->is_here.end(), true));
}

/// The number of worker threads for the nodes and the host, given the size of the pool, if there is one (ComputerRequest).
std::size_t worker_thread_count(const std::optional<std::uint32_t>& pool_threads, std::size_t node_count) {
  return pool_threads ? std::min<std::size_t>(*pool_threads, node_count) : 0;
}

std::uint32_t thread_count(const std::optional<std::uint32_t>& pool_threads, std::size_t node_count) {
  return static_cast<std::uint32_t>(pool_threads ? worker_thread_count(pool_threads, node_count) : node_count);
}

}  // namespace

std::string deadlock_text(const std::optional<Chaos>& chaos) {
  return "all nodes sleep, nothing is under way, and the work is unfinished" +
         (chaos ? " (chaos seed " + std::to_string(chaos->seed) + "):" : ":");
}

NodeThreads::NodeThreads(std::span<const NodeSpecification> specifications, const std::optional<Chaos>& chaos, Observer* observer,
                         const Outlet* outlet, const std::optional<std::uint32_t>& pool_threads, Immutable immutable)
    : chaos_(chaos),
      observer_(observer),
      outlet_(outlet),
      immutable_(immutable),
      awake_(thread_count(pool_threads, count_here(outlet, specifications.size()))),
      uncounted_(0) {
  core::expect(!specifications.empty(), "a computer has at least the host");
  core::expect(pool_threads != 0U, "a pool has a thread");
  core::expect(immutable == Immutable::is_copied || (!chaos && outlet == nullptr), "what is delayed, or leaves, is bytes");
  core::expect(outlet == nullptr || outlet->is_here.size() == specifications.size(), "each node is here or elsewhere");
  const auto peer_count = static_cast<std::uint32_t>(specifications.size());
  const ThreadComputer computer{peer_count, *this, chaos_, observer_, start_ns_, immutable_, std::thread::hardware_concurrency()};
  by_index_.resize(peer_count);
  for (std::uint32_t i = 0; i < peer_count; ++i) {
    if (nodes::is_here(outlet, i)) {
      processors_.push_back(std::make_unique<ThreadProcessor>(specifications[i], NodeId{i}, computer));
      by_index_[i] = processors_.back().get();
    }
  }
  make_worker_threads(worker_thread_count(pool_threads, processors_.size()));
}

/// Neighbours, which communicate most, share a worker thread; the last one has the host.
void NodeThreads::make_worker_threads(std::size_t count) {
  const std::span<const std::unique_ptr<ThreadProcessor>> all = processors_;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t first = all.size() * i / count, end = all.size() * (i + 1) / count;
    worker_threads_.push_back(std::make_unique<WorkerThread>(all.subspan(first, end - first), awake_));
  }
}

NodeThreads::~NodeThreads() = default;

void NodeThreads::deliver(NodeId target, const PacketHeader& header, std::span<const std::byte> payload) {
  ThreadProcessor& source = *by_index_[header.source];
  const bool may_wait = (source.batching.kinds >> header.kind & 1U) != 0;
  PacketHeader sent = header;
  const std::uint32_t index = index_of(target);
  std::span<const std::byte> front;
  if (by_index_[index] == nullptr) {
    front = std::as_bytes(std::span(&index, 1));
    sent.bytes += sizeof(index);
  }
  // Packets of one sender to one target arrive in order, so none overtakes a waiting one.
  if (may_wait || (source.waiting_count > 0 && source.waiting_for == target)) {
    return add_waiting(source, target, sent, payload, front, may_wait);
  }
  core::expect(mailbox_towards(target).push(sent, payload, count_towards(target), front),
               "credits leave room in the target's mailbox");
}

bool NodeThreads::deliver_in_place(NodeId target, const PacketHeader& header, std::span<const std::byte> front,
                                   std::span<const std::byte> immutable) {
  if (immutable_ == Immutable::is_copied) {
    return false;
  }
  ThreadProcessor& source = *by_index_[header.source];
  const bool follows = source.waiting_count > 0 && source.waiting_for == target;
  Mailbox& mailbox = mailbox_towards(target);
  Mailbox::Batch alone;
  core::expect(mailbox.add_in_place(follows ? source.waiting : alone, header, front, immutable),
               "credits leave room in the target's mailbox");
  follows ? hand_over(source) : mailbox.hand_over(alone, awake_);
  return true;
}

void NodeThreads::Bringing::bring(NodeId target, const PacketHeader& header, std::span<const std::byte> payload) {
  core::expect(nodes_->processor(index_of(target)).mailbox.push(header, payload, nodes_->awake_),
               "credits leave room in the target's mailbox");
}

Mailbox& NodeThreads::mailbox_towards(NodeId target) const {
  ThreadProcessor* const here = by_index_[index_of(target)];
  return here != nullptr ? here->mailbox : outlet_->outbox;
}

void NodeThreads::add_waiting(ThreadProcessor& source, NodeId target, const PacketHeader& header,
                              std::span<const std::byte> payload, std::span<const std::byte> front, bool may_wait) {
  core::expect(source.waiting_count == 0 || source.waiting_for == target, "packets that may wait have one target");
  core::expect(mailbox_towards(target).add(source.waiting, header, payload, front), "credits leave room in the target's mailbox");
  source.waiting_for = target;
  if (++source.waiting_count >= source.batching.packets || !may_wait) {
    hand_over(source);
  }
}

void NodeThreads::hand_over(ThreadProcessor& source) {
  mailbox_towards(source.waiting_for).hand_over(source.waiting, count_towards(source.waiting_for));
  source.waiting_count = source.quanta_waited = 0;
}

void NodeThreads::start(std::uint64_t start_ns) {
  start_ns_ = start_ns;
  try {
    start_threads();
  } catch (const core::CapacityError&) {
    fail(std::make_exception_ptr(core::CapacityError(too_few_threads(starts_.size() - 1))));
  } catch (...) {
    fail(std::current_exception());
  }
}

void NodeThreads::begin_again() {
  core::expect(ending() == Ending::finished, "another run begins where one has ended regularly");
  ending_.store(Ending::none, std::memory_order_relaxed);  // no thread is running to see it
  starts_.clear();
  for (const auto& processor : processors_) {
    processor->begin_again();
  }
  for (const auto& worker_thread : worker_threads_) {
    worker_thread->begin_again();
  }
  awake_.begin_again(static_cast<std::uint32_t>(worker_threads_.empty() ? processors_.size() : worker_threads_.size()));
}

void NodeThreads::start_threads() {
  const std::size_t more_bytes = outlet_ != nullptr ? carrier_stack_bytes : 0;
  starts_.reserve(processors_.size());
  for (const auto& worker_thread : worker_threads_) {
    starts_.push_back({this, nullptr, worker_thread.get()});
    worker_thread->thread.start(worker_thread->stack_bytes() + more_bytes, enter, &starts_.back());
  }
  if (!worker_threads_.empty()) {
    return;
  }
  for (const auto& processor : processors_) {
    starts_.push_back({this, processor.get(), nullptr});
    processor->thread.start(processor->memory.plan()[Category::reserve] + more_bytes, enter, &starts_.back());
  }
}

void NodeThreads::join() {
  for (const auto& worker_thread : worker_threads_) {
    worker_thread->thread.join();
  }
  for (const auto& processor : processors_) {
    processor->thread.join();
  }
}

std::string NodeThreads::too_few_threads(std::size_t started) const {
  if (!worker_threads_.empty()) {
    return "a pool of " + std::to_string(worker_threads_.size()) +
           " threads was asked for, and this computer lets dmpc start but " + std::to_string(started) +
           ": ask for fewer threads, or for a higher limit (ulimit -u, pids.max of a container)";
  }
  return "a computer of " + std::to_string(by_index_.size() - 1) + " nodes takes " + std::to_string(processors_.size()) +
         " threads" + (outlet_ == nullptr ? "" : " here") + ", and this one lets dmpc start but " + std::to_string(started) +
         ": ask for fewer nodes, or for a higher limit (ulimit -u, pids.max of a container)";
}

void NodeThreads::enter(void* start) {
  const Start& self = *static_cast<Start*>(start);
  self.worker_thread != nullptr ? self.nodes->run_worker_thread(*self.worker_thread) : self.nodes->run_node(*self.processor);
}

void NodeThreads::run_node(ThreadProcessor& self) {
  core::use_usual_arithmetic();
  NodeCounters& counters = self.node.counters();
  const std::uint64_t start_ns = nanoseconds(CLOCK_MONOTONIC);
  try {
    while (ending() == Ending::none) {
      const Next next = step(self);
      if (next == Next::rest || counters.quanta % quanta_per_look == 0 || has_to_send()) {
        carry();
      }
      if (next == Next::pass) {
        self.pass_idly();
      } else if (next == Next::rest) {
        rest(self);
      }
    }
  } catch (...) {
    fail(std::current_exception());
  }
  counters.busy_ns = nanoseconds(CLOCK_THREAD_CPUTIME_ID);
  counters.wall_ns = nanoseconds(CLOCK_MONOTONIC) - start_ns;
}

void NodeThreads::run_worker_thread(WorkerThread& worker_thread) {
  core::use_usual_arithmetic();
  worker_thread.begin_turns();
  const std::uint64_t start_ns = worker_thread.times.now_ns();
  try {
    while (ending() == Ending::none) {
      worker_thread.awake_nodes.take_woken(
          [&worker_thread](std::uint32_t number) { worker_thread.note_sleep(*worker_thread.nodes[number]); });
      const std::optional<std::uint32_t> next = worker_thread.awake_nodes.next();
      next ? take_turn(worker_thread, *next) : sleep(worker_thread);
    }
  } catch (...) {
    fail(std::current_exception());
  }
  worker_thread.end_turns(start_ns);
}

/// A node runs until it has nothing to do or has used its quanta; if awake, it gets another turn after all others.
void NodeThreads::take_turn(WorkerThread& worker_thread, std::uint32_t number) {
  ThreadProcessor& self = *worker_thread.nodes[number];
  Next next = Next::go_on;
  for (int quantum = 0; next == Next::go_on && quantum < quanta_per_turn && ending() == Ending::none; ++quantum) {
    next = step(self);
    if (has_to_send()) {
      carry();
    }
  }
  if (next == Next::pass) {
    self.pass_idly();
  }
  if (next != Next::rest || !falls_asleep(self)) {
    worker_thread.awake_nodes.stay(number);
  }
  carry();
  worker_thread.end_turn(self);
}

void NodeThreads::carry() const {
  if (outlet_ != nullptr) {
    outlet_->carrier.carry();
  }
}

/// For an idle node on a worker thread: it need not poll for packets that arrive soon, as others have their turn before it.
bool NodeThreads::falls_asleep(ThreadProcessor& self) {
  self.is_asleep = !self.program->has_leftovers() && self.mailbox.fall_asleep();
  self.node.counters().sleeps += self.is_asleep ? 1 : 0;
  return self.is_asleep;
}

/// Receives all packets that have come and works one quantum. A node with delayed packets does not sleep: they are in flight.
NodeThreads::Next NodeThreads::step(ThreadProcessor& self) {
  if (self.sits_out()) {
    return Next::pass;
  }
  self.mailbox.drain([this, &self](const Packet& packet) {
    self.node.counters().received[packet.kind].add(packet.payload_bytes());
    if (observer_ != nullptr) {
      return receive_observed(self, packet);
    }
    self.program->receive(packet);
  });
  const bool has_more = work(self);
  const bool holds_packets = self.holds_packets();
  // Hands over before it sleeps in any case, since one awake node keeps the others from detecting the end.
  if (!has_more || (self.waiting_count > 0 && ++self.quanta_waited >= batching_quanta_max)) {
    hand_over(self);
  }
  return has_more ? Next::go_on : holds_packets ? Next::pass : Next::rest;
}

bool NodeThreads::work(ThreadProcessor& self) {
  if (self.program->finished()) {
    return false;
  }
  ++self.node.counters().quanta;
  if (observer_ != nullptr) {
    return work_observed(self);
  }
  return self.program->work();
}

std::uint64_t NodeThreads::since_start_ns() const { return nanoseconds(CLOCK_MONOTONIC) - start_ns_; }

bool NodeThreads::work_observed(ThreadProcessor& self) {
  Span span = begin_span(self, Activity::work, 0);
  const bool has_more = self.program->work();
  end_span(self, span);
  if (self.is_waiting && !has_more) {
    self.service_idle_ns += span.own_ns;
  } else if (!has_more) {
    self.waits_since_ns = span.end_ns;
    self.service_idle_ns = 0;
  }
  self.is_waiting = !has_more;
  return has_more;
}

void NodeThreads::receive_observed(ThreadProcessor& self, const Packet& packet) {
  Span span = begin_span(self, Activity::receive, packet.kind);
  const bool is_urgent = (self.interrupt_kinds >> packet.kind & 1U) != 0;
  if (self.is_waiting && !is_urgent) {
    end_wait(self, packet, span.begin_ns);
  }
  observer_->received({.node = self.node.id(),
                       .peer = packet.source,
                       .kind = packet.kind,
                       .call = span.call,
                       .payload = packet.payload,
                       .times = {.received_ns = span.begin_ns},
                       .immutable_bytes = packet.immutable.size()});
  self.program->receive(packet);
  end_span(self, span);
  self.service_idle_ns += self.is_waiting ? span.own_ns : 0;
}

/// Work for others ends no wait, as on a modelled machine.
void NodeThreads::end_wait(ThreadProcessor& self, const Packet& packet, std::uint64_t end_ns) const {
  self.is_waiting = false;
  observer_->waited({.node = self.node.id(),
                     .peer = packet.source,
                     .kind = packet.kind,
                     .begin_ns = self.waits_since_ns,
                     .end_ns = end_ns,
                     .own_ns = end_ns - self.waits_since_ns - self.service_idle_ns});
}

Span NodeThreads::begin_span(ThreadProcessor& self, Activity activity, PacketKind packet) const {
  return {.node = self.node.id(),
          .activity = activity,
          .packet = packet,
          .call = ++self.call,
          .begin_ns = since_start_ns(),
          .before = self.charged};
}

void NodeThreads::end_span(ThreadProcessor& self, Span& span) const {
  span.end_ns = since_start_ns();
  span.own_ns = span.end_ns - span.begin_ns;
  span.after = self.charged = self.program->charges();
  observer_->ended(span, *self.program);
}

/// Called with nothing to do: sleeps until a packet comes or the run ends.
void NodeThreads::rest(ThreadProcessor& self) {
  if (packet_comes_soon(self) || self.program->has_leftovers() || !go_to_sleep(self.mailbox)) {
    return;
  }
  ++self.node.counters().sleeps;
  const std::uint64_t start_ns = nanoseconds(CLOCK_MONOTONIC);
  self.mailbox.wait();
  self.node.counters().asleep_ns += nanoseconds(CLOCK_MONOTONIC) - start_ns;
}

/// Sleeps until a node is woken or the run ends.
void NodeThreads::sleep(WorkerThread& worker_thread) {
  if (go_to_sleep(worker_thread.awake_nodes.woken())) {
    worker_thread.share_out_time();
    worker_thread.awake_nodes.woken().wait();
    worker_thread.begin_turns();
  }
}

/// Whether to sleep at a node's mailbox, or a worker thread's.
bool NodeThreads::go_to_sleep(Mailbox& inbox) {
  // The order matters: ASLEEP first, so that end() either finds it or is seen; then the count, so that zero means all ASLEEP.
  if (!inbox.fall_asleep() || ending() != Ending::none) {
    return false;
  }
  if (!awake_.leave()) {
    return true;
  }
  if (outlet_ != nullptr) {
    outlet_->call.rouse();
    return true;
  }
  end(unfinished_count() == 0 ? Ending::finished : Ending::stalled);  // every node sleeps: no program can continue
  return false;
}

void NodeThreads::fail(std::exception_ptr failure) {
  if (!failing_.exchange(true, std::memory_order_relaxed)) {
    failure_ = std::move(failure);
    end(Ending::failed);
  }
}

void NodeThreads::end(Ending ending) {
  Ending none = Ending::none;
  // Release: pairs with the load in ending().
  if (!ending_.compare_exchange_strong(none, ending, std::memory_order_release, std::memory_order_relaxed)) {
    return;
  }
  for (const auto& worker_thread : worker_threads_) {
    worker_thread->awake_nodes.woken().rouse();
  }
  if (worker_threads_.empty()) {
    for (const auto& processor : processors_) {
      processor->mailbox.rouse();
    }
  }
  if (outlet_ != nullptr) {
    outlet_->call.rouse();
  }
}

std::uint32_t NodeThreads::unfinished_count() const {
  return static_cast<std::uint32_t>(std::count_if(processors_.begin(), processors_.end(),
                                                  [](const auto& processor) { return !processor->program->finished(); }));
}

std::string NodeThreads::describe() const { return nodes::describe(processors_); }

void NodeThreads::expect_nothing_lies_about() const {
  for (const auto& processor : processors_) {
    core::expect(!processor->mailbox.has_packets(), "at the end all mailboxes are empty");
    core::expect(!processor->held || processor->held->empty(), "at the end no packet is held back");
  }
}

ThreadProcessor& NodeThreads::processor(std::size_t index) const {
  core::expect(is_here(index), "only a node that is here can be looked at");
  return *by_index_[index];
}

}  // namespace dmpc::nodes
