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
  Owner(std::uint32_t senders, std::uint32_t count) : memory(plan_for(senders, count)), places(memory, senders, count) {}

  static nodes::MemoryPlan plan_for(std::uint32_t senders, std::uint32_t count) {
    nodes::MemoryPlan plan;
    Places::add_needs(plan, senders, count);
    return plan;
  }

  nodes::LocalMemory memory;
  Places places;
};

}  // namespace

TEST_CASE("free places are granted to who has asked for longest, and no more than there are") {
  Owner owner(3, 2);
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
  Owner owner(2, 1);
  owner.places.ask(NodeId{0});
  owner.places.ask(NodeId{1});
  CHECK_THROWS_AS(owner.places.ask(NodeId{0}), core::InternalError);
}

TEST_CASE("without shared places the account takes no memory") {
  Owner owner(5, 0);
  CHECK(owner.memory.used().total() == Owner::plan_for(0, 0).total());
  CHECK_FALSE(owner.places.grant());
}

}  // namespace places_test
