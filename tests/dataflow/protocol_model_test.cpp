// The rules of flow control and termination, in every order of events, and what becomes of them when one rule is broken.

#include "tests/dataflow/protocol_model.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>

#include "tests/dataflow/state_explorer.h"

namespace dmpc::tests::protocol_model_test {

namespace {

/// Sanitizers look for other mistakes: they get fewer children, the slower one fewer still.
#if defined(__SANITIZE_THREAD__)
constexpr std::uint8_t spared = 2;
#elif defined(__SANITIZE_ADDRESS__)
constexpr std::uint8_t spared = 1;
#else
constexpr std::uint8_t spared = 0;
#endif

constexpr std::uint8_t children(std::uint8_t count) { return static_cast<std::uint8_t>(count - std::min(count, spared)); }

template <class Rules = ProtocolRules>
StateReport explore(const ProtocolSettings& settings) {
  const ProtocolModel<Rules> model(settings);
  return StateExplorer(model).explore();
}

template <class Rules = ProtocolRules>
void check_all_orders(const ProtocolSettings& settings, std::uint64_t states_min) {
  check_no_failure(explore<Rules>(settings), spared == 0 ? states_min : 10);
}

template <class Rules = ProtocolRules>
void check_found(const ProtocolSettings& settings, const std::string& words) {
  check_failure(explore<Rules>(settings), words);
}

struct WithoutOverflow : ProtocolRules {
  static dataflow::Way way_of(bool owner, bool queue, bool) { return dataflow::way_of(owner, queue, false); }
};

struct ForwardingBlindly : ProtocolRules {
  static bool forwards(std::uint64_t kept, bool) { return kept > 0; }
};

struct RestingOnCredits : ProtocolRules {
  static bool returns_credits(std::uint32_t owed, std::uint32_t batch, bool) {
    return dataflow::returns_credits(owed, batch, false);
  }
};

struct WorkingOn : ProtocolRules {
  static dataflow::Task next_task(dataflow::NodeState state) {
    state.packet_waits = state.packet_waits && !state.is_tracing;
    return dataflow::next_task(state);
  }
};

struct PassiveWithQueue : ProtocolRules {
  static bool is_passive(dataflow::NodeState state) {
    state.has_gathered = false;
    return dataflow::is_passive(state);
  }
};

struct HoldingBackForEver : ProtocolRules {
  static bool admits_primaries(std::uint32_t, std::uint32_t) { return false; }
};

struct Colorless : ProtocolRules {
  struct Termination : dataflow::Termination {
    static Termination initiator(const dataflow::TerminationTree& tree) { return {dataflow::Termination::initiator(tree)}; }
    static Termination member(nodes::NodeId node, const dataflow::TerminationTree& tree) {
      return {dataflow::Termination::member(node, tree)};
    }
    std::optional<dataflow::TokenHandover> hand_on() {
      auto handover = dataflow::Termination::hand_on();
      if (handover) {
        handover->token.is_black = 0;
      }
      return handover;
    }
  };
};

/// Believes the first of its children for all.
struct Hasty : ProtocolRules {
  struct Termination : dataflow::Termination {
    static Termination initiator(const dataflow::TerminationTree& tree) { return {dataflow::Termination::initiator(tree)}; }
    static Termination member(nodes::NodeId node, const dataflow::TerminationTree& tree) {
      return {dataflow::Termination::member(node, tree)};
    }
    void take(const dataflow::Token& token) {
      dataflow::Termination::take(token);
      while (awaited() > 0) {
        dataflow::Termination::take({});
      }
    }
  };
};

struct FillingOn : ProtocolRules {
  static bool must_close(std::uint32_t, std::uint32_t) { return false; }
};

struct AskingTwice : ProtocolRules {
  static bool asks(bool rays, bool credit, bool) { return dataflow::asks(rays, credit, false); }
};

struct NotAsking : ProtocolRules {
  static bool asks(bool, bool, bool) { return false; }
};

struct InstancingPlaces : ProtocolRules {
  static bool declines(bool, bool) { return false; }
};

struct GrantingBlindly : ProtocolRules {
  static bool grants(std::uint32_t, bool is_asked) { return is_asked; }
};

struct AskingOn : ProtocolRules {
  static bool may_ask(std::uint32_t, std::uint32_t) { return true; }
};

struct PassiveUnanswered : ProtocolRules {
  static bool is_passive(dataflow::NodeState state) {
    state.is_unanswered = false;
    return dataflow::is_passive(state);
  }
};

}  // namespace

TEST_CASE("without any ray the end is proved") { check_all_orders({.primaries = {0, 0, 0}, .children = 0}, 10); }

TEST_CASE("one ray without children ends") { check_all_orders({.primaries = {0, 1, 0}, .children = 0}, 20); }

TEST_CASE("rays that branch end in every order of events, and the end is proved then and only then") {
  check_all_orders({.primaries = {1, 1, 1}, .children = children(2)}, 20'000);
  check_all_orders({.primaries = {1, 0, 0}, .children = children(3)}, 30'000);
  check_all_orders({.primaries = {1, 1, 0}, .children = children(3)}, 100'000);
}

TEST_CASE("two nodes that flood each other go on by way of the host" * doctest::test_suite("slow")) {
  check_all_orders({.primaries = {2, 0, 0}, .children = children(3), .owners = 2}, 10'000);
  check_all_orders({.primaries = {1, 1, 0}, .children = children(4), .owners = 2}, 100'000);
}

TEST_CASE("packets of several rays end in every order of events") {
  check_all_orders({.primaries = {1, 1, 0}, .children = children(3), .rays_a_packet = 2}, 30'000);
}

TEST_CASE("several credits returned together end in every order of events") {
  check_all_orders({.primaries = {1, 1, 0}, .children = children(2), .credits_each = 2, .return_batch = 2}, 5'000);
  check_all_orders({.primaries = {1, 1, 0}, .children = children(2), .return_batch = 2}, 5'000);
}

TEST_CASE("packets that wait in a queue leave in every order of events" * doctest::test_suite("slow")) {
  check_all_orders({.primaries = {2, 0, 0}, .children = children(3), .queue_packets = 1, .owners = 2}, 10'000);
  check_all_orders({.primaries = {1, 1, 0}, .children = children(3), .queue_packets = 1}, 10'000);
  check_all_orders({.primaries = {1, 1, 0}, .children = children(4), .queue_packets = 2, .owners = 2}, 10'000);
}

TEST_CASE("primary rays that start whatever waits end in every order of events") {
  check_all_orders({.primaries = {2, 1, 0}, .children = children(2), .queue_packets = 1, .has_backpressure = false, .owners = 2},
                   1'000);
  check_all_orders({.primaries = {1, 1, 0}, .children = children(3), .queue_packets = 1, .has_backpressure = false}, 10'000);
}

TEST_CASE("places that are shared and asked for become free again in every order of events" * doctest::test_suite("slow")) {
  check_all_orders({.primaries = {1, 1, 0}, .children = children(2), .shared_slots = 1}, 10'000);
  check_all_orders({.primaries = {1, 0, 0}, .children = children(3), .shared_slots = 1}, 10'000);
  check_all_orders({.primaries = {1, 1, 0}, .children = children(3), .shared_slots = 2, .owners = 2}, 10'000);
  check_all_orders({.primaries = {1, 0, 0}, .children = children(2), .queue_packets = 1, .shared_slots = 1}, 5'000);
  check_all_orders({.primaries = {1, 1, 0}, .children = children(2), .queue_packets = 1, .shared_slots = 1, .owners = 2}, 5'000);
}

TEST_CASE("nodes that fill one packet at a time go on in every order of events" * doctest::test_suite("slow")) {
  check_all_orders({.primaries = {1, 1, 0}, .children = children(2), .rays_a_packet = 2, .shared_slots = 1, .open_packets = 1},
                   1'000);
  check_all_orders({.primaries = {1, 0, 0},
                    .children = children(2),
                    .rays_a_packet = 2,
                    .queue_packets = 1,
                    .shared_slots = 1,
                    .open_packets = 2},
                   1'000);
}

TEST_CASE("nodes that ask one owner at a time go on in every order of events" * doctest::test_suite("slow")) {
  check_all_orders({.primaries = {1, 1, 0}, .children = children(2), .shared_slots = 1, .asks_max = 1}, 1'000);
  check_all_orders({.primaries = {1, 0, 0}, .children = children(2), .queue_packets = 2, .shared_slots = 1, .asks_max = 1},
                   1'000);
}

TEST_CASE("without the way by the host there is a deadlock") {
  check_found<WithoutOverflow>({.primaries = {1, 1, 0}, .children = 4, .owners = 2}, "deadlock");
}

TEST_CASE("a host that forwards without credit floods a backlog") {
  check_found<ForwardingBlindly>({.primaries = {2, 0, 0}, .children = 3, .owners = 2}, "has its place in the backlog");
}

TEST_CASE("a host that keeps credits is found out") {
  check_found({.primaries = {1, 0, 0}, .children = 3, .owners = 2, .host_returns_credit = false}, "deadlock");
}

TEST_CASE("a node that rests on credits leaves the host with its rays") {
  check_found<RestingOnCredits>({.primaries = {2, 0, 0}, .children = 3, .return_batch = 2, .owners = 2}, "deadlock");
}

TEST_CASE("a node that works on while a packet waits has no room for the next") {
  check_found<WorkingOn>({.primaries = {1, 0, 0}, .children = 2}, "one packet at most waits");
}

TEST_CASE("a node that takes queued rays for nothing lets the end be announced too early") {
  check_found<PassiveWithQueue>({.primaries = {1, 0, 0}, .children = 4, .queue_packets = 1, .owners = 2},
                                "only when no ray is left");
}

TEST_CASE("a node that holds its primary rays back whatever its queue never ends") {
  check_found<HoldingBackForEver>({.primaries = {1, 1, 0}, .children = 3, .queue_packets = 1, .owners = 2}, "deadlock");
}

TEST_CASE("a node that fills on has no packet for the next ray") {
  check_found<FillingOn>({.primaries = {1, 0, 0}, .children = 2, .rays_a_packet = 2, .shared_slots = 1, .open_packets = 1},
                         "finds a packet to be put into");
}

TEST_CASE("a node that asks again before it has its answer has no room for that in the mailbox") {
  check_found<AskingTwice>({.primaries = {2, 0, 0}, .children = 3, .queue_packets = 1, .shared_slots = 1, .owners = 2},
                           "a request has its place");
}

TEST_CASE("without asking for shared places queued rays wait for ever") {
  check_found<NotAsking>({.primaries = {2, 0, 0}, .children = 3, .queue_packets = 1, .shared_slots = 1, .owners = 2}, "deadlock");
}

TEST_CASE("a node that keeps the place it no longer needs keeps others from theirs" * doctest::test_suite("slow")) {
  check_found<InstancingPlaces>({.primaries = {1, 1, 0}, .children = 3, .shared_slots = 1, .owners = 2}, "deadlock");
}

TEST_CASE("an owner that grants what it does not have floods its backlog") {
  check_found<GrantingBlindly>({.primaries = {2, 1, 0}, .children = 3, .shared_slots = 1, .owners = 3}, "place");
}

TEST_CASE("a node that asks more owners than may answer has no room for their grants") {
  check_found<AskingOn>({.primaries = {1, 0, 0}, .children = 3, .shared_slots = 1, .asks_max = 1}, "a grant has its place");
}

TEST_CASE("a node that forgets whom it has not asked waits for ever") {
  check_found({.primaries = {1, 0, 0}, .children = 2, .queue_packets = 2, .shared_slots = 1, .asks_max = 1, .asks_again = false},
              "deadlock");
}

TEST_CASE("a node that takes an unanswered request for nothing lets the end be announced too early" *
          doctest::test_suite("slow")) {
  check_found<PassiveUnanswered>({.primaries = {0, 1, 0}, .children = 2, .shared_slots = 1}, "no place is asked for");
}

TEST_CASE("without colours the end is announced too early") {
  check_found<Colorless>({.primaries = {0, 1, 0}, .children = 3}, "only when no ray is left");
}

TEST_CASE("a host that waits for one of its children lets the end be announced too early") {
  check_found<Hasty>({.primaries = {0, 1, 0}, .children = 0}, "only when no ray is left");
}

TEST_CASE("a busy node that hands the token on lets the end be announced too early") {
  check_found({.primaries = {1, 0, 0}, .children = 0, .token_waits_for_rest = false}, "only when no ray is left");
}

TEST_CASE("rays that go by way of the host uncounted let the end be announced too early") {
  check_found({.primaries = {0, 0, 1}, .children = 2, .counts_overflow = false}, "only when no ray is left");
}

}  // namespace dmpc::tests::protocol_model_test
