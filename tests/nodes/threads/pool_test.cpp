// A few threads that drive all nodes in turn: what programs see, how runs end, and who is told what.
#include <doctest/doctest.h>
#include <time.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/expect.h"
#include "nodes/ranks/ranks_runner.h"
#include "nodes/runner.h"
#include "nodes/threads/delayed_packets.h"
#include "nodes/threads/threads_runner.h"
#include "tests/nodes/toy_machine.h"
#include "tests/nodes/toy_programs.h"
#include "tests/support/loopback_ranks.h"

namespace dmpc::tests::pool_test {
namespace {

using namespace nodes;

/// A runner with a pool of so many threads.
ThreadsRunner pooled(std::uint32_t threads, const std::vector<NodeSpecification>& specifications,
                     const std::optional<Chaos>& chaos = std::nullopt, Observer* observer = nullptr) {
  return ThreadsRunner(specifications, chaos, observer, threads);
}

/// Its thread's processor time.
std::uint64_t processor_ns() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<std::uint64_t>(now.tv_sec) * 1'000'000'000U + static_cast<std::uint64_t>(now.tv_nsec);
}

/// Node 1 computes for 20 ms in one quantum, then tells node 0; the others do nothing.
class OneComputes : public ToyProgram {
 public:
  explicit OneComputes(Node& node) : ToyProgram(node) { node.grant(NodeId{0}, 0); }
  void receive(const Packet& /*packet*/) override { is_reported_ = true; }
  bool work() override {
    if (index() == 1) {
      for (const std::uint64_t end_ns = processor_ns() + 20'000'000; processor_ns() < end_ns;) {
      }
      node().send_reserved(NodeId{0}, 0, 1, std::uint32_t{0});
      is_reported_ = true;
    }
    return false;
  }
  bool finished() const override { return index() > 1 || is_reported_; }

 private:
  bool is_reported_ = false;
};

/// Counts quanta that others had between two of its own, through a number that all share, which no program may: for a test.
class TakesTurns : public ToyProgram {
 public:
  TakesTurns(Node& node, std::vector<std::uint32_t>& order) : ToyProgram(node), order_(&order) {}
  bool work() override {
    if (left_ > 0) {
      --left_;
      order_->push_back(index());
    }
    return left_ > 0;
  }
  bool finished() const override { return left_ == 0; }

 private:
  std::vector<std::uint32_t>* order_;
  std::uint32_t left_ = 100;
};

TEST_CASE("a pool without a thread is none, and each process may use a processor") {
  CHECK_THROWS_AS(pooled(0, equal_nodes(9, TokenRound::mailbox, making<TokenRound>(5U))), core::InternalError);
  CHECK(nodes::processors_allowed() >= 1);
}

TEST_CASE("nodes of one thread take turns, none waits until another has no more to do") {
  std::vector<std::uint32_t> order;
  ThreadsRunner runner =
      pooled(1, equal_nodes(3, {}, [&order](Node& node) { return std::make_unique<TakesTurns>(node, order); }));
  CHECK(runner.run({}) == RunEnd::finished);
  REQUIRE(order.size() == 300);
  const auto first = [&order](std::uint32_t node) { return std::find(order.begin(), order.end(), node) - order.begin(); };
  CHECK(first(1) < 100);
  CHECK(first(2) < 200);
  CHECK(order.back() == 2);
}

TEST_CASE("a pool's processor time is that of the node whose turn it is, sleep that of a node without packets") {
  ThreadsRunner runner = pooled(1, equal_nodes(3, {.small_slots = 1}, making<OneComputes>()));
  CHECK(runner.run({}) == RunEnd::finished);
  const NodeCounters& waits = runner.node(0).counters();
  CHECK(runner.node(1).counters().busy_ns >= 19'000'000);
  CHECK(runner.node(1).counters().busy_ns > waits.busy_ns);
  CHECK(waits.sleeps == 2);
  CHECK(waits.asleep_ns > 19'000'000);
  for (std::uint32_t i = 0; i < 3; ++i) {
    CHECK(runner.node(i).counters().asleep_ns <= runner.node(i).counters().wall_ns);
    CHECK(runner.node(i).counters().quanta == (i < 2 ? 1 : 0));
  }
}

/// Counts what it is told, each node's for itself.
class Counts final : public Observer {
 public:
  explicit Counts(std::size_t peer_count) : sent_by(peer_count), received_by(peer_count), last_ns(peer_count) {}
  void ended(const Span& span, const Program& /*program*/) override {
    const std::size_t node = index_of(span.node);
    in_order = in_order && last_ns[node] <= span.begin_ns && span.begin_ns <= span.end_ns;
    last_ns[node] = span.end_ns;
  }
  void sent(const Passing& packet) override { ++sent_by[index_of(packet.node)]; }
  void received(const Passing& packet) override { ++received_by[index_of(packet.node)]; }

  std::vector<std::uint64_t> sent_by, received_by, last_ns;
  std::atomic<bool> in_order{true};
};

TEST_CASE("an observer of a pool is told of each node, its calls one after the other") {
  Counts counts(9);
  ThreadsRunner runner = pooled(2, equal_nodes(9, TokenRound::mailbox, making<TokenRound>(20U)), std::nullopt, &counts);
  CHECK(runner.run({}) == RunEnd::finished);
  CHECK(counts.sent_by == std::vector<std::uint64_t>(9, 20));
  CHECK(counts.received_by == std::vector<std::uint64_t>(9, 20));
  CHECK(counts.in_order);
}

/// Runs on so many ranks, each with a pool of so many threads, and calls look(runner) after a regular end.
template <class Look>
void run_on_ranks(std::uint32_t ranks, std::uint32_t threads, const std::vector<NodeSpecification>& specifications,
                  const std::optional<Chaos>& chaos, const Look& look) {
  const auto results = on_ranks(ranks, {.seed = ranks, .late_polls_max = 9}, [&](Fabric& fabric) {
    RankLinks links(fabric);
    RanksRunner runner(specifications, links, chaos, nullptr, threads);
    const RunEnd end = runner.run({});
    look(runner);
    return end;
  });
  for (const auto& result : results) {
    CHECK(result.failure_text() == "");
    CHECK((result.value && *result.value == RunEnd::finished));
  }
}

TEST_CASE("within a rank a pool drives the rank's nodes") {
  for (const std::uint32_t ranks : {1U, 2U, 5U}) {
    for (const std::uint32_t threads : {1U, 2U, 9U}) {
      CAPTURE(ranks);
      CAPTURE(threads);
      run_on_ranks(ranks, threads, equal_nodes(24, Requester::mailbox(24, 2), making<Requester>(10U, 2U)), std::nullopt,
                   [](RanksRunner& runner) {
                     for (std::uint32_t i = 0; i < 24; ++i) {
                       CHECK((!runner.is_here(i) || program_of<Requester>(runner, i).all_right()));
                     }
                   });
    }
  }
}

TEST_CASE("pools on ranks copy what never changes, whether it leaves its rank or not") {
  for (const std::uint32_t ranks : {1U, 2U}) {
    run_on_ranks(ranks, 1, equal_nodes(3, {.small_slots = 3}, making<SendsLasting>()), std::nullopt, [](RanksRunner& runner) {
      CHECK((!runner.is_here(1) || program_of<SendsLasting>(runner, 1).is_whole));
      CHECK((!runner.is_here(1) || !program_of<SendsLasting>(runner, 1).is_in_place));
    });
  }
}

TEST_CASE("ranks with pools are disturbed by chaos as others are") {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    run_on_ranks(3, 2, disturbed(equal_nodes(12, TokenRound::mailbox, making<TokenRound>(5U))), chaos_of(seed),
                 [](RanksRunner&) {});
  }
}

TEST_CASE("a stall of pools on ranks is found on all of them") {
  const auto results = on_ranks(2, {}, [&](Fabric& fabric) {
    RankLinks links(fabric);
    return RanksRunner(equal_nodes(5, {}, making<Waiter>()), links, std::nullopt, nullptr, 1).run({});
  });
  for (const auto& result : results) {
    CHECK(result.failure_text().find("all nodes sleep") != std::string::npos);
  }
}

}  // namespace
}  // namespace dmpc::tests::pool_test
