// An owner's account of the slots for received packets: whose they are and, if nodes share them, how many are free, and which
// nodes wait for one.
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

/// Accounts of the backlog's slots: one per sender, which has its own credits; or, if nodes share them, one for all nodes, and
/// the host's. Shared slots are granted in the order of the requests. Each node has at most one request that is not granted, so a
/// ring of as many is enough. Thread safety: belongs to one node.
class Slots {
 public:
  struct Capacity {
    std::uint32_t node_count = 1;
    std::uint32_t shared = 0;        ///< slots that nodes share and ask for; 0: they have credits of their own
    std::uint32_t ray_credits = 1;   ///< per node
    std::uint32_t host_credits = 1;  ///< the host's, node `node_count`

    std::uint32_t account_count() const { return shared > 0 ? 2 : node_count + 1; }
    std::uint32_t ring_size() const { return shared == 0 ? 0 : node_count; }
  };

  /// All slots are free.
  Slots(nodes::LocalMemory& memory, const Capacity& capacity)
      : capacity_(capacity), asking_(layout(capacity).in(memory)), free_(capacity.shared) {}
  /// The memory that the constructor takes.
  static nodes::Room<std::uint16_t> layout(const Capacity& capacity) { return {nodes::Category::queues, capacity.ring_size()}; }

  std::uint32_t account_of(nodes::NodeId sender) const {
    const std::uint32_t index = nodes::index_of(sender);
    return capacity_.shared == 0 ? index : index == capacity_.node_count ? 1 : 0;
  }
  bool is_shared(std::uint32_t account) const { return capacity_.shared > 0 && account == 0; }
  /// Requires that the account is not shared.
  nodes::NodeId sender_of(std::uint32_t account) const {
    return nodes::NodeId{capacity_.shared > 0 ? capacity_.node_count : account};
  }
  /// Whether the `owed` slots of an account become free for others, or their credits are returned, now.
  bool gives_back(std::uint32_t account, std::uint32_t owed, bool rests) const {
    return is_shared(account) || returns_credits(owed, return_batch(credits_of(sender_of(account))), rests);
  }

  /// Adds a node that waits for a slot.
  void ask(nodes::NodeId sender) {
    core::expect(asking_count_ < asking_.size(), "a node asks again only when it has its answer");
    asking_[(first_ + asking_count_++) % asking_.size()] = static_cast<std::uint16_t>(nodes::index_of(sender));
  }
  /// Frees `count` shared slots.
  void give_back(std::uint32_t count) { free_ += count; }
  /// Takes a free slot for the longest waiting node, if there are both.
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

  std::uint32_t free() const { return free_; }
  bool are_all_free() const { return free_ == capacity_.shared && asking_count_ == 0; }
  /// Number of waiting nodes.
  std::uint32_t asking() const { return asking_count_; }

 private:
  std::uint32_t credits_of(nodes::NodeId sender) const {
    return nodes::index_of(sender) == capacity_.node_count ? capacity_.host_credits : capacity_.ray_credits;
  }

  Capacity capacity_;
  std::span<std::uint16_t> asking_;
  std::uint32_t free_;
  std::uint32_t first_ = 0, asking_count_ = 0;
};

}  // namespace dmpc::dataflow
