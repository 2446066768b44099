#include "nodes/virtual/virtual_runner.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/expect.h"
#include "core/base/sampling.h"
#include "nodes/processors.h"
#include "nodes/runner.h"
#include "nodes/virtual/event_queue.h"
#include "nodes/virtual/links.h"
#include "nodes/virtual/path_finder.h"
#include "nodes/virtual/virtual_processor.h"

namespace dmpc::nodes {
namespace {

/// Events between two polls for a request to stop.
constexpr std::uint64_t events_per_look = 1024;

/// The approximate time between events, if each node has a message in flight or a quantum in progress; for an EventQueue.
std::uint64_t event_distance_ns(const Machine& machine, std::size_t peer_count) {
  return std::max<std::uint64_t>((machine.short_message.send_ns + machine.short_message.latency_ns) / peer_count, 1);
}

}  // namespace

struct VirtualRunner::Implementation {
  virtual ~Implementation() = default;
  virtual RunEnd run(const std::stop_token& stop) = 0;

  VirtualComputer computer;
  VirtualReport result;
};

/// `is_watched`: there is an observer. Otherwise no code is compiled for it.
template <bool is_watched>
struct VirtualRunner::Simulation final : VirtualRunner::Implementation {
  Simulation(std::span<const NodeSpecification> specifications, const Machine& model, Observer* looking_on)
      : machine(model),
        observer(looking_on),
        links(model, static_cast<std::uint32_t>(std::max<std::size_t>(specifications.size(), 2) - 1)),
        events(event_distance_ns(model, std::max<std::size_t>(specifications.size(), 1))) {
    core::expect(!specifications.empty(), "a computer has at least the host");
    if (is_watched && observer->follows_paths()) {
      paths.emplace(specifications.size());
    }
    const auto peer_count = static_cast<std::uint32_t>(specifications.size());
    for (std::uint32_t i = 0; i < peer_count; ++i) {
      computer.processors.push_back(std::make_unique<VirtualProcessor>(specifications[i], NodeId{i}, peer_count, computer));
    }
  }

  RunEnd run(const std::stop_token& stop) override {
    if (std::exchange(is_started, true)) {
      begin_again();
    }
    for (const auto& processor : computer.processors) {
      go_on(*processor);
    }
    while (!events.empty()) {
      if (result.events % events_per_look == 0 && stop.stop_requested()) {
        return RunEnd::interrupted;
      }
      happen(events.pop());
    }
    finish();
    is_finished = true;
    return RunEnd::finished;
  }

  /// The machine is at rest, so it is reset: its links are free, and its time begins.
  void begin_again() {
    core::expect(is_finished, "another run begins where one has ended regularly");
    is_finished = false;
    links = Links(machine, std::max<std::uint32_t>(static_cast<std::uint32_t>(computer.processors.size()), 2) - 1);
    events = EventQueue(event_distance_ns(machine, computer.processors.size()));
    result = {};
    for (const auto& processor : computer.processors) {
      processor->begin_again(machine.price_ps(processor->program->charges()));
    }
  }

  // ---- Events ------------------------------------------------------------------------------------------------------------

  void happen(const Event& event) {
    VirtualProcessor& source = *computer.processors[event.source()];
    if (event.kind == Event::Kind::is_free && event.time_ns() < source.occupied_until_ns) {
      return post(source, Event::Kind::is_free, source.occupied_until_ns);  // delayed
    }
    ++result.events;
    take_into_hash(event);
    switch (event.kind) {
      case Event::Kind::enters:
        return enter(event.packet);
      case Event::Kind::arrives:
        return arrive(event.packet);
      case Event::Kind::is_free:
        return become_free(source);
    }
  }

  void take_into_hash(const Event& event) {
    result.hash = core::mix(result.hash ^ event.time_ns());
    result.hash = core::mix(result.hash ^ (std::uint64_t{event.source()} << 8U | static_cast<std::uint64_t>(event.kind)));
    if (event.kind != Event::Kind::is_free) {
      const Message& message = computer.messages[event.packet];
      const std::uint64_t to = std::uint64_t{index_of(message.target)} << 8U | message.header.kind;
      result.hash = core::mix(result.hash ^ (to << 32U | message.bytes()));
    }
  }

  void post(VirtualProcessor& source, Event::Kind kind, std::uint64_t time_ns, std::uint32_t packet = 0) {
    events.push({Event::order_of(time_ns, source.id, source.sequence++), kind, packet});
  }

  /// A processor has sent a message, which enters the network after its latency, after those to the same target.
  void leave(VirtualProcessor& self, std::uint32_t number, std::uint64_t time_ns, std::uint64_t call) {
    const Message& message = computer.messages[number];
    if constexpr (is_watched) {
      report_sent(number, time_ns, call);
    }
    std::uint64_t& enters_ns = self.ways[index_of(message.target)].last_enters_ns;
    enters_ns = std::max(enters_ns, time_ns + machine.cost_of_message(message.bytes()).latency_ns);
    post(self, Event::Kind::enters, enters_ns, number);
  }

  /// A message enters the network: reserves its links.
  void enter(std::uint32_t number) {
    const Message& message = computer.messages[number];
    const NodeId source{message.header.source};
    VirtualProcessor& sender = *computer.processors[index_of(source)];
    std::uint64_t& arrives_ns = sender.ways[index_of(message.target)].last_arrives_ns;
    [[maybe_unused]] const std::uint64_t waited_ns = links.traffic().wait_ns;
    arrives_ns = std::max(arrives_ns, links.pass(source, message.target, events.now_ns(), message.bytes()));
    if constexpr (is_watched) {
      MessageTimes& times = computer.messages[number].times;
      times.entered_ns = events.now_ns();
      times.links_ns = links.traffic().wait_ns - waited_ns;
      times.arrived_ns = arrives_ns;
      if (paths) {
        paths->travels(number, message.header.kind, arrives_ns - times.left_ns, times.links_ns);
      }
    }
    post(sender, Event::Kind::arrives, arrives_ns, number);
  }

  void arrive(std::uint32_t number) {
    const Message& message = computer.messages[number];
    VirtualProcessor& target = *computer.processors[index_of(message.target)];
    target.node.counters().received[message.header.kind].add(message.header.bytes);
    if ((target.interrupt_kinds >> message.header.kind & 1U) != 0) {
      return serve(target, number);
    }
    const std::uint64_t receive_ns = machine.cost_of_message(message.bytes()).receive_ns;
    target.times.receiving_ns += receive_ns;
    target.inbox.push(computer.messages, number);
    if (target.is_occupied) {
      target.occupied_until_ns += receive_ns;
      if constexpr (is_watched) {
        target.span.received_ns += receive_ns;
      }
      follow_receiving(target, message.header.kind, receive_ns);
    } else {
      const std::uint64_t begin_ns = end_wait(target, number);
      follow_receiving(target, message.header.kind, receive_ns);
      begin(target, target.span, Activity::take_over, message.header.kind, begin_ns, receive_ns);
      occupy(target, begin_ns + receive_ns);
    }
  }

  /// The end of a wait, when the requested services are over: returns the time.
  std::uint64_t end_wait(VirtualProcessor& self, std::uint32_t number) {
    const std::uint64_t begin_ns = std::max(events.now_ns(), self.served_until_ns);
    const std::uint64_t own_ns = begin_ns - self.idle_since_ns - (self.times.service_idle_ns - self.service_idle_before_ns);
    self.times.waiting_ns[computer.messages[number].header.kind] += own_ns;
    if constexpr (is_watched) {
      if (begin_ns > self.idle_since_ns) {
        report_wait(self, number, begin_ns, own_ns);
      }
    }
    return begin_ns;
  }

  /// An interrupt, served first come, first served, whatever the program was doing.
  void serve(VirtualProcessor& self, std::uint32_t number) {
    const std::uint64_t receive_ns = machine.cost_of_message(computer.messages[number].bytes()).receive_ns;
    const std::uint64_t start_ns = std::max(events.now_ns(), self.served_until_ns);
    begin(self, self.service, Activity::serve, computer.messages[number].header.kind, start_ns);
    [[maybe_unused]] const PacketKind kind = computer.messages[number].header.kind;
    receive(self, number, self.service);
    std::uint64_t service_ns = receive_ns + machine.service_ns + charge(self);
    follow_service(self, number, kind, start_ns > events.now_ns(), service_ns);
    for (const std::uint32_t reply : self.sent) {
      const Message& message = computer.messages[reply];
      const std::uint64_t send_ns = machine.cost_of_message(message.bytes()).send_ns;
      service_ns += send_ns;
      if (is_watched && paths) {
        paths->answers(self.id, reply, message.header.kind, send_ns);
      }
      leave(self, reply, start_ns + service_ns, self.service.call);
    }
    self.sent.clear();
    charged(self, self.service, service_ns);
    end(self, self.service, start_ns + service_ns);
    self.served_until_ns = start_ns + service_ns;
    if (self.is_occupied) {
      self.occupied_until_ns += service_ns;
      self.times.service_busy_ns += service_ns;
      if (is_watched && paths) {
        paths->loses(self.id, service_ns);
      }
    } else {
      self.times.service_idle_ns += service_ns;
    }
  }

  /// The current activity ends: its packets leave, then the program continues.
  void become_free(VirtualProcessor& self) {
    self.is_occupied = false;
    const bool sends = !self.outgoing.empty();
    std::uint64_t sent_ns = events.now_ns();
    for (const std::uint32_t number : self.outgoing) {
      const Message& message = computer.messages[number];
      const std::uint64_t send_ns = machine.cost_of_message(message.bytes()).send_ns;
      sent_ns += send_ns;
      if (is_watched && paths) {
        paths->sends(self.id, number, message.header.kind, send_ns, sent_ns);
      }
      leave(self, number, sent_ns, self.span.call);
    }
    self.outgoing.clear();
    end(self, self.span, events.now_ns());
    if (!sends) {
      return go_on(self);
    }
    self.times.sending_ns += sent_ns - events.now_ns();
    begin(self, self.span, Activity::send, 0, events.now_ns(), sent_ns - events.now_ns());
    occupy(self, sent_ns);
  }

  /// Handles the next packet, or runs the next quantum, or nothing.
  void go_on(VirtualProcessor& self) {
    const std::uint64_t now_ns = events.now_ns();
    if (!self.inbox.empty()) {
      const std::uint32_t number = self.inbox.pop(computer.messages);
      begin(self, self.span, Activity::receive, computer.messages[number].header.kind, now_ns);
      receive(self, number, self.span);
      self.has_more = true;
    } else if (self.has_more && !self.program->finished()) {
      begin(self, self.span, Activity::work, 0, now_ns);
      ++self.node.counters().quanta;
      self.has_more = self.program->work() || self.program->has_leftovers();
    } else {
      self.idle_since_ns = now_ns;
      self.service_idle_before_ns = self.times.service_idle_ns;
      return;
    }
    std::swap(self.outgoing, self.sent);  // empty until now
    const std::uint64_t computing_ns = charge(self);
    self.times.computing_ns += computing_ns;
    charged(self, self.span, computing_ns);
    if (is_watched && paths) {
      paths->computes(self.id, computing_ns);
    }
    occupy(self, now_ns + computing_ns);
  }

  void occupy(VirtualProcessor& self, std::uint64_t until_ns) {
    self.is_occupied = true;
    self.occupied_until_ns = until_ns;
    post(self, Event::Kind::is_free, until_ns);
  }

  /// The time of the operations that the program has charged since the last call.
  std::uint64_t charge(VirtualProcessor& self) {
    const Charges now = self.program->charges();
    if constexpr (is_watched) {
      self.charged = now;
    }
    const std::uint64_t before_ps = std::exchange(self.charged_ps, machine.price_ps(now));
    const std::uint64_t price_ps = self.remainder_ps + (self.charged_ps - before_ps);
    self.remainder_ps = price_ps % 1000;
    return price_ps / 1000;
  }

  // ---- For an observer -----------------------------------------------------------------------------------------------------

  void receive(VirtualProcessor& self, std::uint32_t number, const Span& span) {
    if constexpr (is_watched) {
      Message& message = computer.messages[number];
      message.times.received_ns = span.begin_ns;
      observer->received(passing(message, self.node.id(), NodeId{message.header.source}, span.call));
    }
    self.receive(number);
  }

  /// Begins a span; if it is no call of the program, `own_ns` is known.
  void begin(VirtualProcessor& self, Span& span, Activity activity, PacketKind packet, std::uint64_t begin_ns,
             std::uint64_t own_ns = 0) const {
    if constexpr (is_watched) {
      const bool is_call = activity != Activity::send && activity != Activity::take_over;
      span = {.node = self.node.id(),
              .activity = activity,
              .packet = packet,
              .call = is_call                      ? ++self.calls
                      : activity == Activity::send ? span.call
                                                   : self.calls,
              .begin_ns = begin_ns,
              .own_ns = own_ns,
              .is_in_idle = !self.is_occupied,
              .before = self.charged,
              .after = self.charged};
    }
  }

  /// The call has been made, and its operations are priced.
  void charged(const VirtualProcessor& self, Span& span, std::uint64_t own_ns) const {
    if constexpr (is_watched) {
      span.own_ns = own_ns;
      span.after = self.charged;
    }
  }

  void end(const VirtualProcessor& self, Span& span, std::uint64_t end_ns) const {
    if constexpr (is_watched) {
      span.end_ns = end_ns;
      observer->ended(span, *self.program);
    }
  }

  /// A message that the sender's processor has finished at `time_ns`.
  void report_sent(std::uint32_t number, std::uint64_t time_ns, std::uint64_t call) {
    Message& message = computer.messages[number];
    message.times = {.sending_ns = time_ns - machine.cost_of_message(message.bytes()).send_ns, .left_ns = time_ns};
    observer->sent(passing(message, NodeId{message.header.source}, message.target, call));
  }

  /// Reports the wait of a node that a message ends, which has arrived or is handled when a service is over.
  void report_wait(VirtualProcessor& self, std::uint32_t number, std::uint64_t end_ns, std::uint64_t own_ns) {
    const Message& message = computer.messages[number];
    Waited wait{.node = self.id,
                .peer = NodeId{message.header.source},
                .kind = message.header.kind,
                .begin_ns = self.idle_since_ns,
                .end_ns = end_ns,
                .own_ns = own_ns};
    if (paths) {
      paths->is_woken(self.id, number, end_ns > events.now_ns());
      wait.left_ns = message.times.left_ns;
      paths->describe(wait);
    }
    observer->waited(wait);
  }

  void follow_receiving(const VirtualProcessor& self, PacketKind kind, std::uint64_t receive_ns) {
    if (is_watched && paths) {
      paths->receives(self.id, kind, receive_ns);
    }
  }

  /// A service begins, and takes this long until it answers.
  void follow_service(const VirtualProcessor& self, std::uint32_t number, PacketKind kind, bool is_queued, std::uint64_t ns) {
    if (is_watched && paths) {
      paths->begins_service(self.id, number, kind, is_queued);
      paths->serves(self.id, kind, ns);
    }
  }

  static Passing passing(const Message& message, NodeId node, NodeId peer, std::uint64_t call) {
    return {node, peer, message.header.kind, call, message.payload, message.times, message.immutable.size()};
  }

  // ---- The end -----------------------------------------------------------------------------------------------------------

  /// Ends the run: nothing is in flight any more.
  void finish() {
    const auto& all = computer.processors;
    if (!all_finished(all)) {
      throw DeadlockError("nothing is under way, no node has work, and the run is unfinished:" + describe(all));
    }
    expect_nothing_lost();
    result.total_ns = events.now_ns();
    for (const auto& processor : all) {
      result.total_ns = std::max(result.total_ns, processor->served_until_ns);
    }
    for (const auto& processor : all) {
      VirtualTimes& times = processor->times;
      times.end_ns = result.total_ns - processor->idle_since_ns - (times.service_idle_ns - processor->service_idle_before_ns);
      core::expect(times.total_ns() == result.total_ns, "the parts of a node's time add up to the run's");
      result.nodes.push_back(times);
    }
    if (is_watched && paths) {
      result.critical_path = paths->path_to(result.total_ns);
    }
    result.machine_digest = machine.digest();
    links.expect_sums();
    result.links = links.traffic();
    result.links_used = links.used_count();
    result.busiest_links = links.busiest(busiest_links_max);
  }

  void expect_nothing_lost() const {
    for (const auto& processor : computer.processors) {
      core::expect(processor->small_held == 0 && processor->bulk_held == 0, "at the end all mailboxes are empty");
    }
    expect_all_received(computer.processors);
  }

  Machine machine;
  Observer* observer;               ///< null unless is_watched
  std::optional<PathFinder> paths;  ///< if the observer follows paths
  Links links;
  EventQueue events;
  bool is_started = false, is_finished = false;
};

VirtualRunner::VirtualRunner(std::span<const NodeSpecification> specifications, const Machine& machine, Observer* observer) {
  if (observer != nullptr) {
    implementation_ = std::make_unique<Simulation<true>>(specifications, machine, observer);
  } else {
    implementation_ = std::make_unique<Simulation<false>>(specifications, machine, observer);
  }
}
VirtualRunner::~VirtualRunner() = default;

RunEnd VirtualRunner::run(std::stop_token stop) { return implementation_->run(stop); }

Node& VirtualRunner::node(std::size_t index) { return implementation_->computer.processors.at(index)->node; }
Program& VirtualRunner::program(std::size_t index) { return *implementation_->computer.processors.at(index)->program; }
std::vector<std::string> VirtualRunner::gather(const Report& report) {
  const auto& processors = implementation_->computer.processors;
  return reported_by(processors, processors.size(), report);
}
std::optional<VirtualReport> VirtualRunner::virtual_report() const { return implementation_->result; }

}  // namespace dmpc::nodes
