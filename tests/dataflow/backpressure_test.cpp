#include "dataflow/backpressure.h"

#include <doctest/doctest.h>

#include "core/base/expect.h"

namespace dmpc::tests::backpressure_test {

using dataflow::Backpressure;

TEST_CASE("a node announces a long queue once, and takes it back when the queue is short") {
  Backpressure node(0, 64);
  CHECK_FALSE(node.is_due(15));
  CHECK(node.is_due(16));
  CHECK(node.announce(16));
  for (const std::uint32_t queued : {64U, 16U, 15U, 9U}) {
    CHECK_FALSE(node.is_due(queued));
  }
  CHECK(node.is_due(8));
  CHECK_FALSE(node.announce(8));
  CHECK(node.is_settled());
  CHECK(node.count() == 1);
}

TEST_CASE("a node announces nothing more before all others have acknowledged") {
  Backpressure node(2, 8);
  CHECK(node.announce(2));
  CHECK_FALSE(node.is_due(0));
  node.acknowledged();
  CHECK_FALSE(node.is_due(0));
  CHECK_THROWS_AS(node.announce(0), core::InternalError);
  node.acknowledged();
  CHECK(node.is_due(0));
  CHECK_THROWS_AS(node.acknowledged(), core::InternalError);
}

TEST_CASE("a node is settled when nothing is announced and all is acknowledged") {
  Backpressure node(1, 8);
  CHECK(node.is_settled());
  node.announce(8);
  CHECK_FALSE(node.is_settled());
  node.acknowledged();
  CHECK_FALSE(node.is_settled());
  node.announce(0);
  CHECK_FALSE(node.is_settled());
  node.acknowledged();
  CHECK(node.is_settled());
}

TEST_CASE("primary rays are admitted while no other node asks to hold them back") {
  Backpressure node(2, 8);
  CHECK(node.admits_primaries(0));
  node.take(true);
  node.take(true);
  node.take(false);
  CHECK_FALSE(node.admits_primaries(0));
  node.take(false);
  CHECK(node.admits_primaries(0));
  CHECK_THROWS_AS(node.take(false), core::InternalError);
}

TEST_CASE("a node with more than a few packets in its queue starts no primary ray, unless it does without backpressure") {
  CHECK(Backpressure(2, 8).admits_primaries(1));
  CHECK_FALSE(Backpressure(2, 8).admits_primaries(2));
  CHECK_FALSE(Backpressure(2, 7).admits_primaries(1));
  Backpressure without(2, 8, false);
  CHECK(without.admits_primaries(8));
  CHECK_FALSE(without.is_due(8));
  CHECK(without.is_settled());
}

TEST_CASE("an empty queue is never long, and a queue of one packet is long and short") {
  CHECK_FALSE(Backpressure(1, 0).is_due(0));
  Backpressure node(0, 1);
  CHECK_FALSE(node.is_due(0));
  CHECK(node.announce(1));
  CHECK_FALSE(node.announce(0));
}

}  // namespace dmpc::tests::backpressure_test
