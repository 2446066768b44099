#include "dataflow/termination.h"

#include <doctest/doctest.h>

#include <set>

#include "core/base/expect.h"

namespace dmpc::tests::termination_test {

using dataflow::Termination;
using dataflow::TerminationTree;
using dataflow::Token;
using dataflow::TokenHandover;
using dataflow::TreePlace;
using nodes::NodeId;

namespace {

TokenHandover handed_on(Termination& member) {
  const auto handover = member.hand_on();
  REQUIRE(handover.has_value());
  return *handover;
}

/// A host, its child, and its child's child, which are all passive.
struct Chain {
  static constexpr TerminationTree tree{.node_count = 2, .branches = 1};
  Termination host = Termination::initiator(tree);
  Termination middle = Termination::member(NodeId{0}, tree), last = Termination::member(NodeId{1}, tree);

  /// Down and up: the host has yet to judge.
  void go_round() {
    middle.take(handed_on(host).token);
    last.take(handed_on(middle).token);
    middle.take(handed_on(last).token);
    host.take(handed_on(middle).token);
  }
  void prove_end() {
    go_round();
    CHECK_FALSE(host.hand_on().has_value());
    CHECK(host.is_terminated());
  }
};

}  // namespace

TEST_CASE("the tree has every node once, below a parent that comes before it") {
  for (const std::uint32_t count : {1U, 2U, 4U, 5U, 6U, 20U, 21U, 1024U}) {
    CAPTURE(count);
    const TerminationTree tree{count};
    std::set<std::uint32_t> met;
    for (std::uint32_t member = 0; member <= count; ++member) {
      const TreePlace place = tree.place_of(NodeId{member});
      for (std::uint32_t i = 0; i < place.child_count; ++i) {
        const NodeId child{place.first_child + i};
        CHECK(met.insert(nodes::index_of(child)).second);
        CHECK(tree.place_of(child).parent == NodeId{member});
        CHECK((member == count || member < nodes::index_of(child)));
      }
      CHECK(place.child_count <= 4);
      CHECK(tree.packets_max(NodeId{member}) <= (member == count ? 4 : tree.packets_max(NodeId{0})));
    }
    CHECK(met.size() == count);
  }
}

TEST_CASE("the host is called first, and that alone proves nothing") {
  Termination host = Termination::initiator({.node_count = 9});
  CHECK(host.holds_token());
  const TokenHandover call = handed_on(host);
  CHECK(call.first == NodeId{0});
  CHECK(call.count == 4);
  CHECK(call.token == Token{});
  CHECK_FALSE(host.is_terminated());
  CHECK_FALSE(host.holds_token());
}

TEST_CASE("one round without any packet proves the end") {
  Chain chain;
  chain.prove_end();
  CHECK_FALSE(chain.host.hand_on().has_value());
}

TEST_CASE("a packet received since the round before, or the start, asks for another round") {
  Chain chain;
  chain.last.ray_packet_sent();
  chain.middle.ray_packet_received();
  chain.go_round();
  CHECK(chain.host.token() == Token{0, 1});
  chain.go_round();
  CHECK_FALSE(chain.host.hand_on().has_value());
  CHECK(chain.host.is_terminated());
}

TEST_CASE("a packet under way keeps the end from being proved, round after round") {
  Chain chain;
  chain.last.ray_packet_sent();
  for (int round = 0; round < 3; ++round) {
    chain.go_round();
    CHECK(chain.host.token() == Token{1, 0});
  }
  chain.host.ray_packet_received();
  CHECK(chain.host.hand_on().has_value());  // black now
  CHECK_FALSE(chain.host.is_terminated());
}

TEST_CASE("what begins again is proved anew, from the packets that follow") {
  Chain chain;
  CHECK_THROWS_AS(chain.host.begin_again(), core::InternalError);
  chain.prove_end();
  chain.host.begin_again();
  CHECK_FALSE(chain.host.is_terminated());
  chain.host.ray_packet_sent();
  for (int round = 0; round < 3; ++round) {  // the packet is under way
    chain.go_round();
    CHECK(chain.host.token() == Token{0, 0});
  }
  chain.last.ray_packet_received();
  chain.go_round();
  CHECK(chain.host.token() == Token{-1, 1});
  chain.prove_end();
}

TEST_CASE("a member tells when all below it have told, and not before it is called") {
  const TerminationTree tree{.node_count = 3, .branches = 2};
  Termination member = Termination::member(NodeId{0}, tree);
  CHECK_FALSE(member.hand_on().has_value());
  member.take({});
  CHECK(handed_on(member).first == NodeId{2});
  CHECK_FALSE(member.hand_on().has_value());
  member.ray_packet_sent();
  member.take({.balance = 2, .is_black = 1});
  const TokenHandover reported = handed_on(member);
  CHECK(reported.token == Token{3, 1});
  CHECK(reported.first == NodeId{3});
  CHECK(reported.count == 1);
  CHECK_FALSE(member.hand_on().has_value());
}

TEST_CASE("a second call in a round is a broken tree") {
  Termination member = Termination::member(NodeId{0}, {.node_count = 1});
  member.take({});
  CHECK_THROWS_AS(member.take({}), core::InternalError);
}

}  // namespace dmpc::tests::termination_test
