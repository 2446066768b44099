// A few threads that drive all nodes in turn: what programs see, how runs end, and who is told what.
#include <doctest/doctest.h>
#include <time.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/base/expect.h"
#include "nodes/ranks/ranks_runner.h"
#include "nodes/runner.h"
#include "nodes/threads/held_packets.h"
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
  void receive(const Packet& /*packet*/) override { is_told_ = true; }
  bool work() override {
    if (index() == 1) {
      for (const std::uint64_t end_ns = processor_ns() + 20'000'000; processor_ns() < end_ns;) {
      }
      node().send_reserved(NodeId{0}, 0, 1, std::uint32_t{0});
      is_told_ = true;
    }
    return false;
  }
  bool finished() const override { return index() > 1 || is_told_; }

 private:
  bool is_told_ = false;
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

std::string stall_of(ThreadsRunner& runner) {
  try {
    runner.run({});
  } catch (const core::InternalError& error) {
    return error.what();
  }
  return "";
}

TEST_CASE("programs that are finished from the start end the run of a pool, of fewer nodes than threads, too") {
  for (const std::uint32_t threads : {1U, 2U, 5U}) {
    for (const std::uint32_t count : {1U, 2U, 65U}) {
      CAPTURE(threads);
      CAPTURE(count);
      ThreadsRunner runner = pooled(threads, equal_nodes(count, {}, making<ToyProgram>()));
      CHECK(runner.run({}) == RunEnd::finished);
      CHECK(runner.node(0).counters().quanta == 0);
    }
  }
}

TEST_CASE("a pool without a thread is none, and each process may use a processor") {
  CHECK_THROWS_AS(pooled(0, equal_nodes(9, TokenRound::mailbox, making<TokenRound>(5U))), core::InternalError);
  CHECK(nodes::processors_allowed() >= 1);
}

TEST_CASE("a token goes round the ring of a pool's nodes, as it does among threads") {
  for (const std::uint32_t threads : {1U, 2U, 3U}) {
    for (const std::uint32_t count : {1U, 2U, 3U, 65U}) {
      CAPTURE(threads);
      CAPTURE(count);
      ThreadsRunner runner = pooled(threads, equal_nodes(count, TokenRound::mailbox, making<TokenRound>(20U)));
      CHECK(runner.run({}) == RunEnd::finished);
      for (std::uint32_t i = 0; i < count; ++i) {
        CHECK(program_of<TokenRound>(runner, i).passed() == 20);
        CHECK(runner.node(i).counters().sent[1].packets == 20);
        CHECK(runner.node(i).counters().received[1].bytes == 20 * 12);
      }
    }
  }
}

TEST_CASE("every request among a pool's nodes is answered, with one credit or many") {
  for (const std::uint32_t threads : {1U, 2U, 4U}) {
    for (const auto& [peers, window] : {std::pair{2U, 1U}, std::pair{5U, 7U}, std::pair{24U, 1U}}) {
      ThreadsRunner runner = pooled(threads, equal_nodes(peers, Asker::mailbox(peers, window), making<Asker>(20U, window)));
      CHECK(runner.run({}) == RunEnd::finished);
      for (std::uint32_t i = 0; i < peers; ++i) {
        CHECK(program_of<Asker>(runner, i).all_right());
        CHECK(runner.node(i).counters().received[request].packets == 20 * (peers - 1));
        CHECK(runner.node(i).counters().received[reply].packets == 20 * (peers - 1));
      }
    }
  }
}

TEST_CASE("many nodes of a pool send to one, each in order") {
  ThreadsRunner runner = pooled(2, equal_nodes(33, AllToHost::mailbox(33), making<AllToHost>(50U)));
  CHECK(runner.run({}) == RunEnd::finished);
  CHECK(program_of<AllToHost>(runner, 32).in_order());
  CHECK(total(runner.node(32).counters().received).packets == 32 * 50);
}

TEST_CASE("packets that may wait arrive in order in a pool, and before their sender sleeps") {
  std::vector<std::uint32_t> expected(Patient::count);
  std::iota(expected.begin(), expected.end(), 0);
  for (const std::uint32_t threads : {1U, 2U}) {
    auto specifications = equal_nodes(2, Patient::mailbox, making<Patient>(6U));
    specifications[0].patience = {.kinds = 1U << 1U, .packets = 5};
    ThreadsRunner runner = pooled(threads, specifications);
    CHECK(runner.run({}) == RunEnd::finished);
    CHECK(program_of<Patient>(runner, 1).received() == expected);
  }
}

TEST_CASE("a node of a pool that puts work off, in case a packet comes, does it before it sleeps") {
  for (const std::uint32_t threads : {1U, 3U}) {
    ThreadsRunner runner = pooled(threads, equal_nodes(20, {.small_slots = 1}, making<PutsOff>()));
    CHECK(runner.run({}) == RunEnd::finished);
  }
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

TEST_CASE("a stall of a pool's nodes is found, with a report on every node") {
  for (const std::uint32_t threads : {1U, 2U, 3U}) {
    ThreadsRunner runner = pooled(threads, equal_nodes(3, {}, making<Waiter>()));
    const std::string report = stall_of(runner);
    CHECK(report.find("all nodes sleep") != std::string::npos);
    CHECK(report.find("node 0 (finished): waits for Godot") != std::string::npos);
    CHECK(report.find("node 1: waits for Godot") != std::string::npos);
    CHECK(report.find("host: waits for Godot") != std::string::npos);
  }
}

TEST_CASE("an exception of a program ends a pool's run, whoever sleeps, and comes out of it once") {
  for (const std::uint32_t threads : {1U, 2U, 8U}) {
    auto specifications = equal_nodes(8, {}, making<Waiter>());
    specifications[3].make_program = making<Worker>(true);
    ThreadsRunner runner = pooled(threads, specifications);
    CHECK_THROWS_WITH_AS(runner.run({}), "the hundredth quantum", std::runtime_error);
  }
}

TEST_CASE("a stop request ends a pool's run, whether its threads work or sleep") {
  for (const std::uint32_t threads : {1U, 2U}) {
    auto specifications = equal_nodes(8, {}, making<Waiter>());
    specifications[0].make_program = making<Worker>(false);
    ThreadsRunner runner = pooled(threads, specifications);
    std::stop_source stop;
    std::jthread stopper([&stop] {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      stop.request_stop();
    });
    CHECK(runner.run(stop.get_token()) == RunEnd::interrupted);
  }
}

TEST_CASE("a node has the memory in a pool that it has with a thread of its own") {
  const auto specifications = equal_nodes(4, TokenRound::mailbox, making<TokenRound>(1U));
  ThreadsRunner threads(specifications);
  ThreadsRunner pool = pooled(2, specifications);
  for (std::uint32_t i = 0; i < 4; ++i) {
    CHECK(pool.node(i).memory().sealed());
    CHECK(pool.node(i).memory().used().bytes == threads.node(i).memory().used().bytes);
  }
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

/// Nodes with room for packets held back, small ones.
std::vector<NodeSpecification> disturbed(std::vector<NodeSpecification> specifications) {
  for (NodeSpecification& specification : specifications) {
    specification.held_bytes = HeldPackets::room_bytes(small_payload_bytes);
    specification.plan[Category::queues] += specification.held_bytes;
  }
  return specifications;
}

TEST_CASE("chaos holds packets back and lets nodes of a pool sit out, and every number arrives in order") {
  std::uint64_t held = 0, sat_out = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    CAPTURE(seed);
    ThreadsRunner runner = pooled(static_cast<std::uint32_t>(1 + seed % 3),
                                  disturbed(equal_nodes(9, AllToHost::mailbox(9), making<AllToHost>(30U))), chaos_of(seed));
    CHECK(runner.run({}) == RunEnd::finished);
    CHECK(program_of<AllToHost>(runner, 8).in_order());
    for (std::uint32_t i = 0; i < 9; ++i) {
      held += runner.node(i).counters().held;
      sat_out += runner.node(i).counters().sat_out;
    }
  }
  CHECK(held > 1000);
  CHECK(sat_out > 1000);
}

TEST_CASE("a disturbed node draws in a pool what it draws with a thread of its own") {
  const Chaos chaos{.seed = 7, .held_percent = 50, .slow_node_percent = 100};
  const auto specifications = disturbed(equal_nodes(3, AllToHost::mailbox(3), making<AllToHost>(30U)));
  ThreadsRunner threads(specifications, chaos);
  ThreadsRunner pool = pooled(2, specifications, chaos);
  CHECK(threads.run({}) == RunEnd::finished);
  CHECK(pool.run({}) == RunEnd::finished);
  for (std::uint32_t i = 0; i < 3; ++i) {  // a draw for each packet, whenever it is sent
    CHECK(pool.node(i).counters().held == threads.node(i).counters().held);
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
  void worked(const Worked& /*worked*/) override {}

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
  const auto results = on_ranks(ranks, {.seed = ranks, .late_looks_max = 9}, [&](Fabric& fabric) {
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
      run_on_ranks(ranks, threads, equal_nodes(24, Asker::mailbox(24, 2), making<Asker>(10U, 2U)), std::nullopt,
                   [](RanksRunner& runner) {
                     for (std::uint32_t i = 0; i < 24; ++i) {
                       CHECK((!runner.is_here(i) || program_of<Asker>(runner, i).all_right()));
                     }
                   });
    }
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
