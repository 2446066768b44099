#include "nodes/chaos.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "core/base/expect.h"
#include "nodes/threads/delayed_packets.h"
#include "tests/nodes/toy_machine.h"
#include "tests/support/complaint.h"

namespace dmpc::tests::nodes_chaos_test {
namespace {

using namespace nodes;

template <class Draw>
std::vector<std::uint32_t> draws(Draw draw, int count = 1000) {
  std::vector<std::uint32_t> values;
  for (int i = 0; i < count; ++i) {
    values.push_back(draw());
  }
  return values;
}

std::vector<std::uint32_t> delays(const Chaos& chaos, std::uint32_t source) {
  ChaosDelays of_node(chaos, NodeId{source});
  return draws([&] { return of_node.next_quanta(NodeId{0}); });
}

std::vector<std::uint32_t> pauses(const Chaos& chaos, std::uint32_t node) {
  ChaosPauses of_node(chaos, NodeId{node});
  return draws([&] { return of_node.next_quanta(); });
}

int count_slow_nodes(const Chaos& chaos) {
  int count = 0;
  for (std::uint32_t node = 0; node < 1000; ++node) {
    count += is_slow_node(chaos, NodeId{node}) ? 1 : 0;
  }
  return count;
}

TEST_CASE("one seed, one chaos") {
  for (const std::uint64_t seed : {std::uint64_t{0}, std::uint64_t{1}, ~std::uint64_t{0}}) {
    const Chaos first = chaos_of(seed), second = chaos_of(seed);
    CHECK(first.seed == seed);
    CHECK(first.held_percent == second.held_percent);
    CHECK(delays(first, 5) == delays(second, 5));
    CHECK(pauses(first, 5) == pauses(second, 5));
  }
}

TEST_CASE("every seed stands for settings within their bounds, and seeds differ") {
  std::set<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t>> kinds;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const Chaos chaos = chaos_of(seed);
    CHECK((chaos.held_percent >= 1 && chaos.held_percent <= 100));
    CHECK((chaos.delay_quanta_max >= 1 && chaos.delay_quanta_max <= 128));
    CHECK((chaos.slow_link_factor >= 2 && chaos.slow_link_factor <= 16));
    CHECK((chaos.slow_link_percent <= 50 && chaos.slow_node_percent <= 50 && chaos.idle_quanta_max <= 64));
    kinds.insert({chaos.held_percent, chaos.delay_quanta_max, chaos.slow_node_percent, chaos.idle_quanta_max});
  }
  CHECK(kinds.size() > 900);
}

TEST_CASE("nodes, purposes and seeds draw from streams of their own") {
  const Chaos chaos{.seed = 4, .held_percent = 100, .delay_quanta_max = 8, .slow_node_percent = 100, .idle_quanta_max = 7};
  Chaos other = chaos;
  other.seed = 5;
  CHECK(delays(chaos, 1) != delays(chaos, 2));
  CHECK(delays(chaos, 1) != delays(other, 1));
  CHECK(pauses(chaos, 1) != pauses(chaos, 2));
  std::vector<std::uint32_t> shifted = pauses(chaos, 1);
  std::for_each(shifted.begin(), shifted.end(), [](std::uint32_t& quanta) { ++quanta; });
  CHECK(shifted != delays(chaos, 1));
}

TEST_CASE("so many packets in a hundred are held back, for one to the most quanta") {
  std::vector<std::uint32_t> quanta = delays({.seed = 9, .held_percent = 30, .delay_quanta_max = 5}, 0);
  const auto not_held = std::count(quanta.begin(), quanta.end(), 0U);
  CHECK(not_held > 650);
  CHECK(not_held < 750);
  CHECK(std::set<std::uint32_t>(quanta.begin(), quanta.end()) == std::set<std::uint32_t>{0, 1, 2, 3, 4, 5});
}

TEST_CASE("a slow node sits out up to the most quanta, others none") {
  const Chaos chaos{.seed = 2, .slow_node_percent = 30, .idle_quanta_max = 3};
  const int slow_count = count_slow_nodes(chaos);
  CHECK(slow_count > 230);
  CHECK(slow_count < 370);
  for (std::uint32_t node = 0; node < 20; ++node) {
    const std::vector<std::uint32_t> quanta = pauses(chaos, node);
    CHECK(*std::max_element(quanta.begin(), quanta.end()) == (is_slow_node(chaos, NodeId{node}) ? 3 : 0));
  }
}

TEST_CASE("a share of nothing slows nothing and a share of all slows all") {
  CHECK(count_slow_nodes({.seed = 6, .slow_node_percent = 0}) == 0);
  CHECK(count_slow_nodes({.seed = 6, .slow_node_percent = 100}) == 1000);
  CHECK_FALSE(is_slow_link({.seed = 6, .slow_link_percent = 0}, NodeId{1}, NodeId{2}));
  CHECK(is_slow_link({.seed = 6, .slow_link_percent = 100}, NodeId{1}, NodeId{2}));
}

TEST_CASE("a link is slow or not for the whole run, each way for itself") {
  const Chaos chaos{.seed = 8, .slow_link_percent = 50};
  int differ = 0;
  for (std::uint32_t i = 0; i < 100; ++i) {
    CHECK(is_slow_link(chaos, NodeId{i}, NodeId{i + 1}) == is_slow_link(chaos, NodeId{i}, NodeId{i + 1}));
    differ += is_slow_link(chaos, NodeId{i}, NodeId{i + 1}) != is_slow_link(chaos, NodeId{i + 1}, NodeId{i}) ? 1 : 0;
  }
  CHECK(differ > 20);
}

TEST_CASE("credits shrink to every number from one to what was planned, each kind for itself") {
  std::set<std::uint32_t> seen;
  int ones = 0, kinds_differ = 0;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    const std::uint32_t credits = shrunk_credits({.seed = seed}, 6, 0);
    seen.insert(credits);
    ones += credits == 1 ? 1 : 0;
    kinds_differ += credits != shrunk_credits({.seed = seed}, 6, 1) ? 1 : 0;
  }
  CHECK(seen == std::set<std::uint32_t>{1, 2, 3, 4, 5, 6});
  CHECK(ones > 150);
  CHECK(kinds_differ > 100);
}

TEST_CASE("no credits stay none, one stays one, and they shrink only where chaos says so") {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    CHECK(shrunk_credits({.seed = seed}, 0, 0) == 0);
    CHECK(shrunk_credits({.seed = seed}, 1, 0) == 1);
    CHECK(shrunk_credits({.seed = seed, .shrinks_credits = false}, 6, 0) == 6);
  }
}

TEST_CASE("settings out of range are broken invariants") {
  CHECK_THROWS_AS(ChaosDelays({.delay_quanta_max = 0}, NodeId{0}), core::InternalError);
  CHECK_THROWS_AS(ChaosDelays({.delay_quanta_max = 65537}, NodeId{0}), core::InternalError);
  CHECK_THROWS_AS(ChaosDelays({.slow_link_factor = 0}, NodeId{0}), core::InternalError);
  CHECK_THROWS_AS(ChaosDelays({.slow_link_factor = 32769}, NodeId{0}), core::InternalError);
  CHECK_THROWS_AS(ChaosPauses({.idle_quanta_max = 1U << 31U}, NodeId{0}), core::InternalError);
}

/// Sends every other node the numbers from 0 on, `window` unacknowledged to each at most; each checks their order.
class Counting : public ToyProgram {
 public:
  static MailboxCapacity mailbox(std::uint32_t peer_count, std::uint32_t window) {
    return {.small_slots = 2 * window * (peer_count - 1)};  // the others' numbers, and acknowledgements of this node's
  }

  Counting(Node& node, std::uint32_t count, std::uint32_t window)
      : ToyProgram(node), count_(count), sent_(node.peer_count(), 0), next_of_(node.peer_count(), 0) {
    sent_[index()] = count;
    next_of_[index()] = count;
    unacknowledged_ = std::uint64_t{count} * (node.peer_count() - 1);
    for (std::uint32_t i = 0; i < node.peer_count(); ++i) {
      node.grant(NodeId{i}, 0, window);
    }
  }

  void receive(const Packet& packet) override { packet.kind == 0 ? take(packet) : acknowledged(packet); }
  bool work() override {
    bool has_sent = false;
    for (std::uint32_t i = 0; i < sent_.size(); ++i) {
      if (sent_[i] < count_ && node().try_send(NodeId{i}, 0, 0, sent_[i])) {
        ++sent_[i];
        has_sent = true;
      }
    }
    return has_sent;
  }
  bool finished() const override {
    return unacknowledged_ == 0 &&
           std::all_of(next_of_.begin(), next_of_.end(), [this](std::uint32_t next) { return next == count_; });
  }
  std::string describe() const override { return std::to_string(unacknowledged_) + " unacknowledged"; }
  bool in_order() const { return in_order_; }

 private:
  void take(const Packet& packet) {
    in_order_ = in_order_ && packet.as<std::uint32_t>() == next_of_[index_of(packet.source)]++;
    node().grant(packet.source, 1);
    node().send_reserved(packet.source, 1, 1, std::span<const std::byte>());
  }
  void acknowledged(const Packet& packet) {
    --unacknowledged_;
    node().grant(packet.source, 0);
  }

  std::uint32_t count_;
  std::vector<std::uint32_t> sent_, next_of_;
  std::uint64_t unacknowledged_ = 0;
  bool in_order_ = true;
};

TEST_CASE("under any seed every packet arrives and the order of each pair holds, among threads and in a pool") {
  constexpr std::uint32_t peers = 5, count = 40;
  std::uint64_t held = 0, sat_out = 0;
  for (std::uint64_t seed = 0; seed < 16; ++seed) {
    CAPTURE(seed);
    const Chaos chaos = chaos_of(seed);
    const std::uint32_t window = shrunk_credits(chaos, 4, 0);
    ThreadsRunner runner(disturbed(equal_nodes(peers, Counting::mailbox(peers, 4), making<Counting>(count, window))), chaos,
                         nullptr, seed % 2 == 0 ? std::nullopt : std::optional(static_cast<std::uint32_t>(1 + seed / 2 % 3)));
    CHECK(runner.run({}) == RunEnd::finished);
    for (std::uint32_t i = 0; i < peers; ++i) {
      CHECK(dynamic_cast<Counting&>(runner.program(i)).in_order());
      CHECK(total(runner.node(i).counters().received).packets == 2 * count * (peers - 1));
      held += runner.node(i).counters().held;
      sat_out += runner.node(i).counters().sat_out;
    }
  }
  CHECK(held > 1000);
  CHECK(sat_out > 1000);
}

TEST_CASE("a disturbed node draws in a pool what it draws with a thread of its own") {
  const Chaos chaos{.seed = 7, .held_percent = 50, .slow_node_percent = 100};
  const auto specifications = disturbed(equal_nodes(3, TokenRound::mailbox, making<TokenRound>(60U)));
  ThreadsRunner threads(specifications, chaos), pool(specifications, chaos, nullptr, 2);
  CHECK(threads.run({}) == RunEnd::finished);
  CHECK(pool.run({}) == RunEnd::finished);
  for (std::uint32_t i = 0; i < 3; ++i) {  // a draw for each packet, whenever it is sent
    CHECK(threads.node(i).counters().held > 10);
    CHECK(pool.node(i).counters().held == threads.node(i).counters().held);
  }
}

/// The host waits for a packet more than node 0 sends it.
class Expecting : public ToyProgram {
 public:
  Expecting(Node& node, std::uint32_t sent) : ToyProgram(node), left_(index() == 0 ? sent : sent + 1) {
    node.grant(host(), 0, sent);
  }
  void receive(const Packet& /*packet*/) override { --left_; }
  bool work() override {
    if (index() == 0 && left_ > 0) {
      --left_;
      node().send_reserved(host(), 0, 0, 0);
    }
    return index() == 0 && left_ > 0;
  }
  bool finished() const override { return left_ == 0; }
  std::string describe() const override { return std::to_string(left_) + " missing"; }

 private:
  std::uint32_t left_;
};

TEST_CASE("a stall is found out only when nothing is held back any more, and names the seed") {
  const Chaos chaos{.seed = 77, .held_percent = 100, .delay_quanta_max = 1000, .slow_node_percent = 100};
  ThreadsRunner runner(disturbed(equal_nodes(2, {.small_slots = 10}, making<Expecting>(10U))), chaos);
  const std::string report = tests::complaint_of<core::InternalError>([&] { runner.run({}); });
  CHECK(report.find("chaos seed 77") != std::string::npos);
  CHECK(report.find("host: 1 missing") != std::string::npos);
}

TEST_CASE("a node without room for it holds no packet back") {
  const auto specifications = equal_nodes(3, Counting::mailbox(3, 2), making<Counting>(10U, 2U));
  ThreadsRunner runner(specifications, Chaos{.seed = 1, .held_percent = 100});
  CHECK(runner.run({}) == RunEnd::finished);
  CHECK(runner.node(0).counters().held == 0);
}

/// Broken on purpose. In each round node 0 sends a number to node 1 and word of it to the host, which passes the word on to
/// node 1. Node 1 takes for granted that the number comes first, as it does while packets to different nodes keep their order.
class Presuming : public ToyProgram {
 public:
  static constexpr MailboxCapacity mailbox{.small_slots = 2};  // at node 1: the number and the word of one round

  Presuming(Node& node, std::uint32_t rounds) : ToyProgram(node), rounds_left_(rounds) {
    for (std::uint32_t i = 0; i < 3; ++i) {
      node.grant(NodeId{i}, 0, rounds);
    }
  }

  void receive(const Packet& packet) override {
    switch (index()) {
      case 0:
        is_waiting_ = false;
        return;
      case 1:
        return take(packet.source == host());
      default:
        send(NodeId{1});
        --rounds_left_;
    }
  }
  bool work() override {
    if (index() == 0 && !is_waiting_ && rounds_left_ > 0) {
      is_waiting_ = true;
      --rounds_left_;
      send(NodeId{1});
      send(host());
    }
    return false;
  }
  bool finished() const override { return rounds_left_ == 0 && !is_waiting_; }
  bool presumption_failed() const { return presumption_failed_; }

 private:
  void send(NodeId target) { node().send_reserved(target, 0, 0, index()); }
  /// A round ends when number and word are here.
  void take(bool is_word) {
    ++(is_word ? words_ : numbers_);
    presumption_failed_ = presumption_failed_ || words_ > numbers_;
    if (words_ == numbers_) {
      --rounds_left_;
      send(NodeId{0});
    }
  }

  std::uint32_t rounds_left_;
  std::uint32_t numbers_ = 0, words_ = 0;
  bool is_waiting_ = false, presumption_failed_ = false;
};

bool presumption_fails(const std::optional<Chaos>& chaos) {
  ThreadsRunner runner(disturbed(equal_nodes(3, Presuming::mailbox, making<Presuming>(30U))), chaos);
  CHECK(runner.run({}) == RunEnd::finished);
  return dynamic_cast<Presuming&>(runner.program(1)).presumption_failed();
}

TEST_CASE("a program that relies on the order across pairs is found out by chaos, and only by it") {
  int found = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    CHECK_FALSE(presumption_fails(std::nullopt));
    found += presumption_fails(chaos_of(seed)) ? 1 : 0;
  }
  CHECK(found >= 5);
}

}  // namespace
}  // namespace dmpc::tests::nodes_chaos_test
