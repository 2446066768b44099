// Any programs on one thread, in any legal order of events: what a runner may do, without its clocks and threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <random>
#include <span>
#include <vector>

#include "core/base/expect.h"
#include "nodes/node.h"
#include "nodes/program.h"
#include "nodes/threads/threads_runner.h"

namespace dmpc::tests {

/// A packet on its way.
struct Parcel {
  nodes::NodeId source{}, target{};
  nodes::PacketKind kind = 0;
  std::vector<std::byte> payload;

  nodes::Packet packet() const { return {source, kind, payload}; }
};

/// A network that keeps what is sent, in order.
struct Post final : nodes::Network {
  void deliver(nodes::NodeId target, const nodes::PacketHeader& header, std::span<const std::byte> payload) override {
    parcels.push_back({nodes::NodeId{header.source}, target, header.kind, {payload.begin(), payload.end()}});
  }
  std::deque<Parcel> parcels;
};

/// Each step picks, by a seeded generator, either the oldest packet between two nodes and gives it to its target, or a node that
/// works a quantum: any order that mailboxes keeping each sender's order allow. Watches that no mailbox ever holds more than its
/// capacity.
class ShuffledComputer {
 public:
  ShuffledComputer(std::span<const nodes::NodeSpecification> specifications, std::uint64_t seed)
      : generator_(seed), queues_(specifications.size() * specifications.size()) {
    for (std::uint32_t i = 0; i < specifications.size(); ++i) {
      const auto peer_count = static_cast<std::uint32_t>(specifications.size());
      peers_.push_back(std::make_unique<Peer>(*this, specifications[i], nodes::NodeId{i}, peer_count));
    }
    for (std::size_t i = 0; i < peers_.size(); ++i) {
      peers_[i]->program = specifications[i].make_program(peers_[i]->node);
      peers_[i]->memory.seal();
    }
  }

  /// Runs to the end. Throws core::InternalError if nothing can move, if there is no end, or if a mailbox overflows.
  void run() {
    for (std::uint64_t steps = 0; !is_over(); ++steps) {
      core::expect(step(), "something can move until the run has ended");
      core::expect(steps < steps_max, "a run comes to its end");
    }
  }

  /// One event; false if nothing can move.
  bool step() {
    const std::size_t choices = queues_.size() + peers_.size();
    const std::size_t first = generator_() % choices;
    for (std::size_t i = 0; i < choices; ++i) {
      const std::size_t choice = (first + i) % choices;
      if (choice < queues_.size() ? receive(queues_[choice]) : work(*peers_[choice - queues_.size()])) {
        return true;
      }
    }
    return false;
  }

  nodes::Program& program(std::uint32_t index) { return *peers_[index]->program; }
  nodes::Node& node(std::uint32_t index) { return peers_[index]->node; }

 private:
  static constexpr std::uint64_t steps_max = 3'000'000;

  struct Peer final : nodes::Network {
    Peer(ShuffledComputer& owner, const nodes::NodeSpecification& specification, nodes::NodeId id, std::uint32_t peer_count)
        : computer(&owner), capacity(specification.mailbox), memory(specification.plan), node(id, peer_count, memory, *this) {}
    void deliver(nodes::NodeId target, const nodes::PacketHeader& header, std::span<const std::byte> payload) override {
      computer->put({nodes::NodeId{header.source}, target, header.kind, {payload.begin(), payload.end()}});
    }

    ShuffledComputer* computer;
    nodes::MailboxCapacity capacity;
    nodes::LocalMemory memory;
    nodes::Node node;
    std::unique_ptr<nodes::Program> program;
    std::uint32_t small_held = 0, bulk_held = 0;
    bool may_work = true;
  };

  static std::uint32_t& held(Peer& peer, const Parcel& parcel) {
    return parcel.payload.size() <= nodes::small_payload_bytes ? peer.small_held : peer.bulk_held;
  }

  void put(Parcel parcel) {
    Peer& peer = *peers_[nodes::index_of(parcel.target)];
    ++held(peer, parcel);
    core::expect(peer.small_held <= peer.capacity.small_slots && peer.bulk_held <= peer.capacity.bulk_slots,
                 "no mailbox overflows");
    core::expect(parcel.payload.size() <= std::max(nodes::small_payload_bytes, peer.capacity.bulk_payload_bytes),
                 "a packet fits its slot");
    queues_[nodes::index_of(parcel.source) * peers_.size() + nodes::index_of(parcel.target)].push_back(std::move(parcel));
  }

  /// As the threads runner ends: all programs are finished, and nothing is under way.
  bool is_over() const {
    return std::all_of(peers_.begin(), peers_.end(), [](const auto& peer) { return peer->program->finished(); }) &&
           std::all_of(queues_.begin(), queues_.end(), [](const auto& queue) { return queue.empty(); });
  }

  bool receive(std::deque<Parcel>& parcels) {
    if (parcels.empty()) {
      return false;
    }
    const Parcel parcel = std::move(parcels.front());
    parcels.pop_front();
    Peer& peer = *peers_[nodes::index_of(parcel.target)];
    --held(peer, parcel);
    peer.program->receive(parcel.packet());
    peer.may_work = true;
    return true;
  }

  bool work(Peer& peer) {
    if (!peer.may_work || peer.program->finished()) {
      return false;
    }
    peer.may_work = peer.program->work() || peer.program->has_leftovers();
    return true;
  }

  std::mt19937_64 generator_;
  std::vector<std::unique_ptr<Peer>> peers_;
  std::vector<std::deque<Parcel>> queues_;
};

/// A node of its own, without a thread, and what it sends.
struct SingleNode {
  SingleNode(const nodes::MemoryPlan& plan, std::uint32_t index, std::uint32_t peer_count,
             nodes::Immutable immutable = nodes::Immutable::is_copied)
      : memory(plan, immutable), node(nodes::NodeId{index}, peer_count, memory, post) {}
  /// The oldest packet that it has sent and that has not been taken.
  Parcel take() {
    core::expect(!post.parcels.empty(), "the node has sent a packet");
    Parcel parcel = std::move(post.parcels.front());
    post.parcels.pop_front();
    return parcel;
  }

  Post post;
  nodes::LocalMemory memory;
  nodes::Node node;
};

}  // namespace dmpc::tests
