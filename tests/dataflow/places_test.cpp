#include "dataflow/places.h"

#include <doctest/doctest.h>

#include "core/base/expect.h"

namespace places_test {

using namespace dmpc;
using dataflow::Places;
using nodes::NodeId;

namespace {

/// An owner's account in a memory of its own that fits exactly.
struct Owner {
  explicit Owner(const Places::Capacity& capacity) : memory(Places::layout(capacity)), places(memory, capacity) {}

  nodes::LocalMemory memory;
  Places places;
};

}  // namespace

TEST_CASE("free places are granted to who has asked for longest, and no more than there are") {
  Owner owner({.node_count = 3, .shared = 2});
  CHECK_FALSE(owner.places.grant());
  for (const std::uint32_t sender : {2U, 0U, 1U}) {
    owner.places.ask(NodeId{sender});
  }
  CHECK(owner.places.grant() == NodeId{2});
  CHECK(owner.places.grant() == NodeId{0});
  CHECK_FALSE(owner.places.grant());
  CHECK(owner.places.free() == 0);
  CHECK(owner.places.asking() == 1);
  owner.places.give_back(1);
  owner.places.ask(NodeId{2});
  CHECK(owner.places.grant() == NodeId{1});
  CHECK_FALSE(owner.places.grant());
  owner.places.give_back(2);
  CHECK(owner.places.grant() == NodeId{2});
  CHECK(owner.places.free() == 1);
  CHECK(owner.memory.used().bytes == owner.memory.plan().bytes);
}

TEST_CASE("as many nodes wait as there are, and none twice") {
  Owner owner({.node_count = 2, .shared = 1});
  owner.places.ask(NodeId{0});
  owner.places.ask(NodeId{1});
  CHECK_THROWS_AS(owner.places.ask(NodeId{0}), core::InternalError);
}

TEST_CASE("without shared places the account takes no memory") {
  Owner owner({.node_count = 5, .shared = 0});
  CHECK(owner.memory.used().total() == nodes::MemoryPlan(Places::layout({.node_count = 0})).total());
  CHECK_FALSE(owner.places.grant());
}

TEST_CASE("a sender's own places go back to it by half its credits, or all when the owner rests") {
  Owner owner({.node_count = 3, .ray_credits = 4, .host_credits = 8});
  for (const std::uint32_t sender : {0U, 2U, 3U}) {
    CHECK(owner.places.account_of(NodeId{sender}) == sender);
    CHECK(owner.places.sender_of(sender) == NodeId{sender});
    CHECK_FALSE(owner.places.is_shared(sender));
  }
  CHECK(owner.places.gives_back(2, 2, false));
  CHECK_FALSE(owner.places.gives_back(3, 3, false));
  CHECK(owner.places.gives_back(3, 4, false));
  CHECK(owner.places.gives_back(3, 1, true));
  CHECK_FALSE(owner.places.gives_back(3, 0, true));
}

TEST_CASE("nodes that share places have one account, and the host its own") {
  Owner owner({.node_count = 3, .shared = 5, .ray_credits = 0, .host_credits = 8});
  CHECK(owner.places.account_of(NodeId{0}) == owner.places.account_of(NodeId{2}));
  const std::uint32_t hosts = owner.places.account_of(NodeId{3});
  CHECK(owner.places.is_shared(owner.places.account_of(NodeId{1})));
  CHECK_FALSE(owner.places.is_shared(hosts));
  CHECK(owner.places.sender_of(hosts) == NodeId{3});
  CHECK(owner.places.gives_back(owner.places.account_of(NodeId{1}), 1, false));
  CHECK_FALSE(owner.places.gives_back(hosts, 3, false));
}
}  // namespace places_test
