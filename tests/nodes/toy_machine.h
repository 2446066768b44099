// A small computer for tests: a few toy programs on the threads runner, with a mailbox and a memory of the least size.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "nodes/threads/delayed_packets.h"
#include "nodes/threads/threads_runner.h"

namespace dmpc::tests {

using ProgramMaker = std::function<std::unique_ptr<nodes::Program>(nodes::Node&)>;

/// The memory of a node that has a mailbox, its credits and a stack, and `queue_bytes` for its program.
inline nodes::MemoryPlan least_plan(std::uint32_t peer_count, const nodes::MailboxCapacity& mailbox,
                                    std::size_t queue_bytes = 0) {
  nodes::MemoryPlan plan;
  plan[nodes::Category::mailbox] = mailbox.bytes();
  plan += nodes::credit_table(peer_count);
  plan[nodes::Category::queues] += queue_bytes;
  plan[nodes::Category::reserve] = nodes::thread_stack_bytes_min;
  return plan;
}

/// `count` equal processors; the last is the host.
inline std::vector<nodes::NodeSpecification> equal_nodes(std::uint32_t count, const nodes::MailboxCapacity& mailbox,
                                                         ProgramMaker maker) {
  return std::vector<nodes::NodeSpecification>(count, {least_plan(count, mailbox), mailbox, std::move(maker)});
}

/// With room for packets held back, small ones.
inline std::vector<nodes::NodeSpecification> disturbed(std::vector<nodes::NodeSpecification> specifications) {
  for (nodes::NodeSpecification& specification : specifications) {
    specification.held_bytes = nodes::DelayedPackets::room_bytes(nodes::small_payload_bytes);
    specification.plan[nodes::Category::queues] += specification.held_bytes;
  }
  return specifications;
}

/// A maker of T(node, arguments...).
template <class T, class... Arguments>
ProgramMaker making(Arguments... arguments) {
  return [arguments...](nodes::Node& node) { return std::make_unique<T>(node, arguments...); };
}

/// A program that does nothing and is content with it: the base of those that do something.
class ToyProgram : public nodes::Program {
 public:
  explicit ToyProgram(nodes::Node& node) : node_(node) {}

  void receive(const nodes::Packet& /*packet*/) override {}
  bool work() override { return false; }
  bool finished() const override { return true; }
  std::string describe() const override { return "a toy"; }

 protected:
  nodes::Node& node() { return node_; }
  std::uint32_t index() const { return index_of(node_.id()); }
  nodes::NodeId next_node() const { return nodes::NodeId{(index() + 1) % node_.peer_count()}; }
  nodes::NodeId host() const { return nodes::NodeId{node_.peer_count() - 1}; }

 private:
  nodes::Node& node_;
};

/// Puts its work off once, in case a packet comes.
class PutsOff : public ToyProgram {
 public:
  using ToyProgram::ToyProgram;
  bool work() override {
    ++quanta_;
    return false;
  }
  bool has_leftovers() const override { return quanta_ == 1; }
  bool finished() const override { return quanta_ == 2; }

 private:
  std::uint32_t quanta_ = 0;
};

/// Keeps a token going round the ring of all nodes and the host: `rounds` times.
class TokenRound : public ToyProgram {
 public:
  static constexpr nodes::MailboxCapacity mailbox{.small_slots = 1};

  TokenRound(nodes::Node& node, std::uint32_t rounds) : ToyProgram(node), rounds_left_(rounds), has_token_(index() == 0) {
    node.grant(next_node(), 0);
  }

  void receive(const nodes::Packet& packet) override {
    passed_ += packet.as<std::uint32_t>() == 7 ? 1 : 0;
    has_token_ = true;
  }

  /// The token came all the way round since the last one left, so the credit is back.
  bool work() override {
    if (has_token_ && rounds_left_ > 0) {
      has_token_ = false;
      --rounds_left_;
      node().send_reserved(next_node(), 0, 1, std::uint32_t{7});
      node().grant(next_node(), 0);
    }
    return false;
  }

  bool finished() const override { return rounds_left_ == 0; }
  std::uint32_t passed() const { return passed_; }

 private:
  std::uint32_t rounds_left_;
  std::uint32_t passed_ = 0;
  bool has_token_;
};

}  // namespace dmpc::tests
