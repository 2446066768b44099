// An owner's account of the places for received packets that all senders share: how many are free, and who has asked for one.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/base/expect.h"
#include "dataflow/flow_control.h"
#include "nodes/layout.h"
#include "nodes/local_memory.h"
#include "nodes/node_id.h"

namespace dmpc::dataflow {

/// Grants places in the order of the requests. Each node has at most one request that is not granted, so a ring of as many is
/// enough. Thread safety: belongs to one node.
class Places {
 public:
  /// All of `count` places are free. `sender_count`: nodes that may ask; of no use without places.
  Places(nodes::LocalMemory& memory, std::uint32_t sender_count, std::uint32_t count)
      : asking_(layout(sender_count, count).in(memory)), count_(count), free_(count) {}
  /// What the constructor takes.
  static nodes::Room<std::uint16_t> layout(std::uint32_t sender_count, std::uint32_t count) {
    return {nodes::Category::queues, count == 0 ? 0 : sender_count};
  }

  /// A node waits for a place from now on.
  void ask(nodes::NodeId sender) {
    core::expect(asking_count_ < asking_.size(), "a node asks again only when it has its answer");
    asking_[(first_ + asking_count_++) % asking_.size()] = static_cast<std::uint16_t>(nodes::index_of(sender));
  }
  /// So many places are free again.
  void give_back(std::uint32_t count) { free_ += count; }
  /// Takes a place for who has waited longest, if there are both.
  std::optional<nodes::NodeId> grant() {
    if (!grants(free_, asking_count_ > 0)) {
      return std::nullopt;
    }
    const nodes::NodeId sender{asking_[first_]};
    first_ = (first_ + 1) % static_cast<std::uint32_t>(asking_.size());
    --asking_count_;
    --free_;
    return sender;
  }

  std::uint32_t count() const { return count_; }
  std::uint32_t free() const { return free_; }
  /// Nodes that wait.
  std::uint32_t asking() const { return asking_count_; }

 private:
  std::span<std::uint16_t> asking_;
  std::uint32_t count_, free_;
  std::uint32_t first_ = 0, asking_count_ = 0;
};

}  // namespace dmpc::dataflow
