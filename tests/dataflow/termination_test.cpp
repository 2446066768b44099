#include "dataflow/termination.h"

#include <doctest/doctest.h>

#include "core/base/expect.h"

namespace dmpc::tests::termination_test {

using dataflow::Termination;
using dataflow::Token;
using nodes::NodeId;

namespace {

/// The token of a member that holds one.
Token handed_on(Termination& member) {
  const auto token = member.hand_on();
  REQUIRE(token.has_value());
  return *token;
}

/// Takes the token once around a host and two nodes that are all passive.
void go_round(Termination& host, Termination& last, Termination& first) {
  last.take(handed_on(host));
  first.take(handed_on(last));
  host.take(handed_on(first));
}

}  // namespace

TEST_CASE("the ring goes from the host down the nodes and back") {
  CHECK(dataflow::next_on_ring(NodeId{3}, 3) == NodeId{2});
  CHECK(dataflow::next_on_ring(NodeId{2}, 3) == NodeId{1});
  CHECK(dataflow::next_on_ring(NodeId{0}, 3) == NodeId{3});
  CHECK(dataflow::next_on_ring(NodeId{1}, 1) == NodeId{0});
}

TEST_CASE("the host holds the token first, and that alone proves nothing") {
  Termination host = Termination::initiator();
  CHECK(host.holds_token());
  CHECK(host.hand_on().has_value());
  CHECK_FALSE(host.is_terminated());
  CHECK_FALSE(host.holds_token());
}

TEST_CASE("one round without any packet proves the end") {
  Termination host = Termination::initiator(), last = Termination::member(), first = Termination::member();
  go_round(host, last, first);
  CHECK_FALSE(host.hand_on().has_value());
  CHECK(host.is_terminated());
}

TEST_CASE("a packet received before the token came asks for a second round") {
  Termination host = Termination::initiator(), last = Termination::member(), first = Termination::member();
  first.ray_packet_sent();
  last.ray_packet_received();
  go_round(host, last, first);
  CHECK(host.token() == Token{0, 1});
  go_round(host, last, first);
  CHECK_FALSE(host.hand_on().has_value());
  CHECK(host.is_terminated());
}

TEST_CASE("a packet under way keeps the end from being proved, round after round") {
  Termination host = Termination::initiator(), last = Termination::member(), first = Termination::member();
  first.ray_packet_sent();
  for (int round = 0; round < 3; ++round) {
    go_round(host, last, first);
    CHECK(host.token() == Token{1, 0});
  }
  host.ray_packet_received();
  CHECK(host.hand_on().has_value());  // black now
  CHECK_FALSE(host.is_terminated());
}

TEST_CASE("what begins again is proved anew, from the packets that follow") {
  Termination host = Termination::initiator(), last = Termination::member(), first = Termination::member();
  CHECK_THROWS_AS(host.begin_again(), core::InternalError);
  go_round(host, last, first);
  CHECK_FALSE(host.hand_on().has_value());
  host.begin_again();
  CHECK_FALSE(host.is_terminated());
  host.ray_packet_sent();
  go_round(host, last, first);
  CHECK(host.token() == Token{0, 0});
  CHECK(host.hand_on().has_value());  // the packet is under way
  first.ray_packet_received();
}

TEST_CASE("a member without the token hands nothing on") {
  Termination member = Termination::member();
  CHECK_FALSE(member.hand_on().has_value());
  member.take({});
  CHECK(member.hand_on().has_value());
  CHECK_FALSE(member.hand_on().has_value());
}

TEST_CASE("a second token is a broken ring") {
  Termination member = Termination::member();
  member.take({});
  CHECK_THROWS_AS(member.take({}), core::InternalError);
}

}  // namespace dmpc::tests::termination_test
