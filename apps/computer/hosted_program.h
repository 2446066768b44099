// Adapts a user's program and its Node to the interface of the runners.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "apps/computer/dmpc/computer.h"
#include "apps/computer/plan.h"
#include "apps/computer/program_call.h"
#include "apps/computer/waiting.h"
#include "nodes/node.h"
#include "nodes/program.h"

namespace dmpc::apps {

/// A node with packets, operations and memory by the program's own indices. Restricts the program to its declared needs.
class HostedNode final : public Node {
 public:
  /// Allocates the plan's tables from the node's memory, and grants its credits. Both arguments outlive this object.
  HostedNode(nodes::Node& node, const ProgramPlan& plan);

  std::uint32_t id() const override { return nodes::index_of(node_.id()); }
  std::uint32_t node_count() const override { return plan_.node_count(); }
  std::uint32_t sendable(std::uint32_t target, Index packet) const override;
  [[nodiscard]] bool try_send(std::uint32_t target, Index packet, std::span<const std::byte> payload) override;
  void answer(std::uint32_t target, Index packet, std::span<const std::byte> payload) override;
  void charge(Index operation, std::uint64_t count) override;

  /// Records an arrived packet: an answer returns the right to send its request; a request must be answered.
  void take_note(const nodes::Packet& packet);
  const nodes::Charges& charges() const { return charges_; }
  /// Returns answers that this node expects from others, and those that it owes.
  std::vector<Unanswered> awaited() const;
  std::vector<Unanswered> owed() const;
  /// Returns the allocated bytes of each piece of memory.
  const std::vector<std::size_t>& used_bytes() const { return used_bytes_; }

 private:
  std::byte* allocate_bytes(Index memory, std::size_t bytes) override;
  nodes::Channel channel_of(Index packet) const { return plan_.is_small(packet) ? 0 : 1; }
  /// The remaining credits of a request, or the number of owed answers.
  std::uint16_t& rights(std::uint32_t target, Index packet) const;
  void check(std::uint32_t target, Index packet, std::size_t payload_bytes) const;

  nodes::Node& node_;
  const ProgramPlan& plan_;
  std::span<std::uint16_t> rights_;  ///< by target, then packet
  nodes::Charges charges_;
  std::vector<std::size_t> used_bytes_;
};

/// Wraps the program of a node.
class HostedProgram final : public nodes::Program {
 public:
  using Make = std::function<std::unique_ptr<dmpc::Program>(Node&)>;
  HostedProgram(nodes::Node& node, const ProgramPlan& plan, const Make& make);

  void receive(const nodes::Packet& packet) override;
  bool work() override {
    return call_program(node_.id(), "work()", [this] { return program_->work(); });
  }
  bool finished() const override {
    return call_program(node_.id(), "finished()", [this] { return program_->finished(); });
  }
  nodes::Charges charges() const override { return node_.charges(); }
  std::string describe() const override {
    return call_program(node_.id(), "describe()", [this] { return program_->describe(); }) +
           waiting_text(node_.awaited(), node_.owed());
  }
  /// Returns the result of outcome(program).
  template <class Outcome>
  std::string outcome(const Outcome& outcome) const {
    return call_program(node_.id(), "outcome()", [&] { return outcome(*program_); });
  }

  const HostedNode& node() const { return node_; }

 private:
  static std::unique_ptr<dmpc::Program> made(const Make& make, Node& node);

  HostedNode node_;
  std::unique_ptr<dmpc::Program> program_;
};

}  // namespace dmpc::apps
