// Events of the virtual runner, with programs that do next to nothing: what simulating costs by itself.
#include <chrono>
#include <cstdint>
#include <string>

#include "core/base/expect.h"
#include "nodes/virtual/virtual_runner.h"
#include "tests/bench/groups.h"
#include "tests/nodes/scripted_machine.h"

namespace dmpc::bench {
namespace {

constexpr std::uint32_t node_count = 64;
constexpr std::uint32_t tokens_a_node = 500;

/// Each node starts one token and passes on each that it receives, after one operation; the host, the last processor, looks on.
class Relay final : public tests::ToyProgram {
 public:
  static constexpr nodes::MailboxCapacity mailbox{.small_slots = node_count};

  explicit Relay(nodes::Node& node)
      : ToyProgram(node), tokens_(index() < node_count ? 1 : 0), left_(index() < node_count ? tokens_a_node : 0) {}

  void receive(const nodes::Packet& packet) override {
    core::expect(packet.as<std::uint32_t>() == received_, "tokens come in their order");
    ++received_;
    ++tokens_;
  }
  bool work() override {
    if (tokens_ > 0 && left_ > 0) {
      ++charges_.count[0];
      const nodes::NodeId next{(index() + 1) % node_count};
      node().grant(next, 0);
      node().send_reserved(next, 0, tests::ping, tokens_a_node - left_);
      --tokens_;
      --left_;
    }
    return tokens_ > 0 && left_ > 0;
  }
  bool finished() const override { return left_ == 0 && (index() == node_count || received_ == tokens_a_node); }
  nodes::Charges charges() const override { return charges_; }

 private:
  std::uint32_t tokens_;
  std::uint32_t left_;
  std::uint32_t received_ = 0;
  nodes::Charges charges_;
};

struct Run {
  double seconds = 0;
  std::uint64_t events = 0;
};

/// One run from the first event to the last; building the computer takes no time.
Run run_on(const nodes::Machine& machine) {
  nodes::VirtualRunner runner(tests::equal_nodes(node_count + 1, Relay::mailbox, tests::making<Relay>()), machine);
  const auto begin = std::chrono::steady_clock::now();
  core::expect(runner.run({}) == nodes::RunEnd::finished, "nobody interrupts this run");
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  const nodes::VirtualReport report = *runner.virtual_report();
  core::expect(report.links.messages == std::uint64_t{node_count} * tokens_a_node, "each token is one message");
  return {seconds.count(), report.events};
}

void add(const std::string& subject, nodes::TopologyKind topology, bool has_contention) {
  nodes::Machine machine = tests::toy_model(topology);
  machine.has_contention = has_contention;
  const std::string group = "an event of the virtual runner, " + std::to_string(node_count) + " nodes";
  const std::uint64_t events = run_on(machine).events;
  add_timed_row(group, subject, events, [machine, events] {
    const Run run = run_on(machine);
    core::expect(run.events == events, "equal runs have equal events");
    return run.seconds;
  });
}

}  // namespace

void add_virtual_runner_rows() {
  add("crossbar, no contention", nodes::TopologyKind::crossbar, false);
  add("crossbar", nodes::TopologyKind::crossbar, true);
  add("hypercube", nodes::TopologyKind::hypercube, true);
  add("mesh", nodes::TopologyKind::mesh, true);
}

}  // namespace dmpc::bench
