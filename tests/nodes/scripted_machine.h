// A small computer in virtual time for tests: programs that follow a script, and a machine whose costs can be told apart.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "nodes/virtual/virtual_runner.h"
#include "tests/nodes/toy_machine.h"

namespace dmpc::tests {

/// The kind of packet that scripted processors are interrupted by, and two others.
inline constexpr nodes::PacketKind urgent = 15, ping = 1, pong = 2;
/// So many bytes a short letter has, header included, and a long one.
inline constexpr std::uint64_t short_bytes = 20, long_bytes = 200;

/// A packet that a script sends.
struct Letter {
  std::uint32_t target = 0;
  nodes::PacketKind kind = ping;
  std::uint64_t bytes = short_bytes;  ///< header included: at least 12
};

/// What a program does in one call.
struct Act {
  std::uint64_t operations = 0;
  std::vector<Letter> letters = {};
};

/// What a program does in its run.
struct Script {
  std::vector<Act> quanta = {};                     ///< one after the other
  std::map<nodes::PacketKind, Act> reactions = {};  ///< to a packet of a kind, each time
  std::uint32_t packets_awaited = 0;                ///< until then it is not finished
};

/// Follows its script and writes down what it receives. The operations are rays set up.
class ScriptedProgram final : public ToyProgram {
 public:
  struct Receipt {
    std::uint32_t source = 0;
    nodes::PacketKind kind = 0;
    std::uint32_t number = 0;  ///< among the letters between these two, from 0
  };

  static constexpr nodes::MailboxCapacity mailbox{.small_slots = 64, .bulk_slots = 64, .bulk_payload_bytes = 1024};

  ScriptedProgram(nodes::Node& node, Script script)
      : ToyProgram(node), script_(std::move(script)), letters_to_(node.peer_count(), 0) {
    for (std::uint32_t i = 0; i < node.peer_count(); ++i) {
      node.grant(nodes::NodeId{i}, 0, nodes::credits_max);
    }
  }

  void receive(const nodes::Packet& packet) override {
    std::uint32_t number = 0;
    std::memcpy(&number, packet.payload.data(), sizeof(number));
    receipts_.push_back({index_of(packet.source), packet.kind, number});
    if (const auto reaction = script_.reactions.find(packet.kind); reaction != script_.reactions.end()) {
      perform(reaction->second);
    }
  }
  bool work() override {
    if (next_quantum_ < script_.quanta.size()) {
      perform(script_.quanta[next_quantum_++]);
    }
    return next_quantum_ < script_.quanta.size();
  }
  bool finished() const override { return next_quantum_ == script_.quanta.size() && receipts_.size() >= script_.packets_awaited; }
  nodes::Charges charges() const override { return charges_; }
  std::string describe() const override {
    return std::to_string(receipts_.size()) + " of " + std::to_string(script_.packets_awaited) + " packets";
  }

  const std::vector<Receipt>& receipts() const { return receipts_; }

 private:
  void perform(const Act& act) {
    charges_.count[0] += act.operations;
    for (const Letter& letter : act.letters) {
      std::vector<std::byte> payload(letter.bytes - sizeof(nodes::PacketHeader));
      std::memcpy(payload.data(), &letters_to_[letter.target], sizeof(std::uint32_t));
      ++letters_to_[letter.target];
      node().send_reserved(nodes::NodeId{letter.target}, 0, letter.kind, std::span<const std::byte>(payload));
    }
  }

  Script script_;
  std::vector<std::uint32_t> letters_to_;
  std::vector<Receipt> receipts_;
  nodes::Charges charges_;
  std::size_t next_quantum_ = 0;
};

/// No two sums of a few of its costs are equal. An operation takes a microsecond.
inline nodes::Machine toy_model(nodes::TopologyKind topology = nodes::TopologyKind::crossbar) {
  nodes::Machine machine{.name = "toy", .topology = topology, .short_bytes_max = 100};
  machine.short_message = {.send_ns = 3, .latency_ns = 50, .receive_ns = 7, .byte_ps = 2000};
  machine.long_message = {.send_ns = 11, .latency_ns = 500, .receive_ns = 13, .byte_ps = 3000};
  machine.hop_ns = 100;
  machine.service_ns = 100'000;
  machine.cost_ps[0] = 1'000'000;
  return machine;
}

/// What a run of scripts came to.
struct ScriptedRun {
  nodes::VirtualReport report;
  std::vector<std::vector<ScriptedProgram::Receipt>> receipts;  ///< by processor, in order
  std::vector<nodes::NodeCounters> counters;

  /// When a processor had nothing to do any more. Requires that no interrupt came later.
  std::uint64_t end_ns(std::size_t index) const { return report.total_ns - report.nodes.at(index).end_ns; }
};

/// A computer whose processors follow these scripts, the host the last.
inline std::vector<nodes::NodeSpecification> specifications_of(const std::vector<Script>& scripts) {
  const auto count = static_cast<std::uint32_t>(scripts.size());
  std::vector<nodes::NodeSpecification> specifications;
  for (const Script& script : scripts) {
    specifications.push_back({least_plan(count, ScriptedProgram::mailbox), ScriptedProgram::mailbox,
                              making<ScriptedProgram>(script), 0, 1U << urgent});
  }
  return specifications;
}

/// Runs them to the end.
inline ScriptedRun run_scripts(const std::vector<Script>& scripts, const nodes::Machine& machine = toy_model(),
                               nodes::Observer* observer = nullptr) {
  nodes::VirtualRunner runner(specifications_of(scripts), machine, observer);
  core::expect(runner.run({}) == nodes::RunEnd::finished, "nobody interrupts a scripted run");
  ScriptedRun run{.report = *runner.virtual_report()};
  for (std::size_t i = 0; i < scripts.size(); ++i) {
    run.receipts.push_back(dynamic_cast<ScriptedProgram&>(runner.program(i)).receipts());
    run.counters.push_back(runner.node(i).counters());
  }
  return run;
}

}  // namespace dmpc::tests
