#include "dataflow/slots.h"

#include <doctest/doctest.h>

#include "core/base/expect.h"

namespace dataflow_slots_test {

using namespace dmpc;
using dataflow::Slots;
using nodes::NodeId;

namespace {

/// An owner's account in a memory of its own that fits exactly.
struct Owner {
  explicit Owner(const Slots::Capacity& capacity) : memory(Slots::layout(capacity)), slots(memory, capacity) {}

  nodes::LocalMemory memory;
  Slots slots;
};

}  // namespace

TEST_CASE("free places are granted to who has asked for longest, and no more than there are") {
  Owner owner({.node_count = 3, .shared = 2});
  CHECK_FALSE(owner.slots.grant());
  for (const std::uint32_t sender : {2U, 0U, 1U}) {
    owner.slots.ask(NodeId{sender});
  }
  CHECK(owner.slots.grant() == NodeId{2});
  CHECK(owner.slots.grant() == NodeId{0});
  CHECK_FALSE(owner.slots.grant());
  CHECK(owner.slots.free() == 0);
  CHECK(owner.slots.asking() == 1);
  owner.slots.give_back(1);
  owner.slots.ask(NodeId{2});
  CHECK(owner.slots.grant() == NodeId{1});
  CHECK_FALSE(owner.slots.grant());
  owner.slots.give_back(2);
  CHECK(owner.slots.grant() == NodeId{2});
  CHECK(owner.slots.free() == 1);
  CHECK(owner.memory.used().bytes == owner.memory.plan().bytes);
}

TEST_CASE("as many nodes wait as there are, and none twice") {
  Owner owner({.node_count = 2, .shared = 1});
  owner.slots.ask(NodeId{0});
  owner.slots.ask(NodeId{1});
  CHECK_THROWS_AS(owner.slots.ask(NodeId{0}), core::InternalError);
}

TEST_CASE("without shared places the account takes no memory") {
  Owner owner({.node_count = 5, .shared = 0});
  CHECK(owner.memory.used().total() == nodes::MemoryPlan(Slots::layout({.node_count = 0})).total());
  CHECK_FALSE(owner.slots.grant());
}

TEST_CASE("a sender's own places go back to it by half its credits, or all when the owner rests") {
  Owner owner({.node_count = 3, .ray_credits = 4, .host_credits = 8});
  for (const std::uint32_t sender : {0U, 2U, 3U}) {
    CHECK(owner.slots.account_of(NodeId{sender}) == sender);
    CHECK(owner.slots.sender_of(sender) == NodeId{sender});
    CHECK_FALSE(owner.slots.is_shared(sender));
  }
  CHECK(owner.slots.gives_back(2, 2, false));
  CHECK_FALSE(owner.slots.gives_back(3, 3, false));
  CHECK(owner.slots.gives_back(3, 4, false));
  CHECK(owner.slots.gives_back(3, 1, true));
  CHECK_FALSE(owner.slots.gives_back(3, 0, true));
}

TEST_CASE("nodes that share places have one account, and the host its own") {
  Owner owner({.node_count = 3, .shared = 5, .ray_credits = 0, .host_credits = 8});
  CHECK(owner.slots.account_of(NodeId{0}) == owner.slots.account_of(NodeId{2}));
  const std::uint32_t hosts = owner.slots.account_of(NodeId{3});
  CHECK(owner.slots.is_shared(owner.slots.account_of(NodeId{1})));
  CHECK_FALSE(owner.slots.is_shared(hosts));
  CHECK(owner.slots.sender_of(hosts) == NodeId{3});
  CHECK(owner.slots.gives_back(owner.slots.account_of(NodeId{1}), 1, false));
  CHECK_FALSE(owner.slots.gives_back(hosts, 3, false));
}
}  // namespace dataflow_slots_test
