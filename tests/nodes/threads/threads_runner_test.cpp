#include "nodes/threads/threads_runner.h"

#include <doctest/doctest.h>
#include <sys/resource.h>
#include <time.h>

#include <algorithm>
#include <cfenv>
#include <cstdint>
#include <limits>
#include <optional>

#include "nodes/threads/poll_backoff.h"
#include "tests/nodes/toy_machine.h"
#include "tests/nodes/toy_programs.h"

namespace dmpc::tests::threads_runner_test {
namespace {

using namespace nodes;

/// So often threads of this process have left their core so far.
long thread_switches_now() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_nvcsw + usage.ru_nivcsw;
}

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The host works for so many seconds of its thread's processor time; everyone else has nothing to do until it says so.
class OneWorks : public ToyProgram {
 public:
  OneWorks(Node& node, double seconds) : ToyProgram(node), seconds_(seconds) {
    for (std::uint32_t i = 0; i < node.peer_count(); ++i) {
      node.grant(NodeId{i}, 0);
    }
  }
  void receive(const Packet& /*packet*/) override {
    done_ = true;
    waited_seconds_ = thread_seconds() - began_waiting_seconds_;
  }
  bool work() override {
    if (index() != index_of(host()) || done_) {
      began_waiting_seconds_ = std::min(began_waiting_seconds_, thread_seconds());
      return false;
    }
    if (thread_seconds() < seconds_) {
      return true;
    }
    for (std::uint32_t i = 0; i < node().peer_count(); ++i) {
      node().send_reserved(NodeId{i}, 0, 0, 0);
    }
    return false;
  }
  bool finished() const override { return done_; }
  /// Processor time from the first look for work until the packet came.
  double waited_seconds() const { return waited_seconds_; }

 private:
  double seconds_;
  double began_waiting_seconds_ = std::numeric_limits<double>::infinity();
  double waited_seconds_ = 0.0;
  bool done_ = false;
};

/// Sends packets that may wait to two targets.
class TwoTargets : public ToyProgram {
 public:
  explicit TwoTargets(Node& node) : ToyProgram(node) {
    node.grant(NodeId{0}, 0);
    node.grant(NodeId{1}, 0);
  }
  bool work() override {
    node().send_reserved(NodeId{0}, 0, 1, std::uint32_t{1});
    node().send_reserved(NodeId{1}, 0, 1, std::uint32_t{1});
    has_sent_ = true;
    return false;
  }
  bool finished() const override { return has_sent_; }

 private:
  bool has_sent_ = false;
};

/// Sends one packet that may wait, and works until the other node has answered it, which sleeps meanwhile.
class Longing : public ToyProgram {
 public:
  explicit Longing(Node& node) : ToyProgram(node) { node.grant(NodeId{1 - nodes::index_of(node.id())}, 0); }
  void receive(const Packet& packet) override {
    if (packet.kind == 1) {
      node().send_reserved(packet.source, 0, 2, std::uint32_t{0});
    }
    is_answered_ = true;
  }
  bool work() override {
    if (nodes::index_of(node().id()) == 1) {
      return false;
    }
    if (!has_sent_) {
      node().send_reserved(NodeId{1}, 0, 1, std::uint32_t{0});
      has_sent_ = true;
    }
    return !is_answered_;
  }
  bool finished() const override { return is_answered_; }

 private:
  bool has_sent_ = false, is_answered_ = false;
};

TEST_CASE("a target is not woken for each packet that may wait") {
  auto specifications = equal_nodes(2, Patient::mailbox, making<Patient>(99U));
  specifications[0].batching = {.kinds = 1U << 1U, .packets = 10};
  ThreadsRunner runner(specifications);
  CHECK(runner.run({}) == RunEnd::finished);
  CHECK(runner.node(1).counters().sleeps <= 5);  // before each of four batches, and after
}

TEST_CASE("a packet that may wait does not wait for as long as its sender has work") {
  auto specifications = equal_nodes(2, {.small_slots = 2}, making<Longing>());
  specifications[0].batching = {.kinds = 1U << 1U, .packets = 10};
  ThreadsRunner runner(specifications);
  CHECK(runner.run({}) == RunEnd::finished);
  CHECK(runner.node(0).counters().quanta >= batching_quanta_max);
}

TEST_CASE("packets that may wait have one target") {
  auto specifications = equal_nodes(2, {.small_slots = 4}, making<TwoTargets>());
  specifications[0].batching = {.kinds = 1U << 1U, .packets = 10};
  ThreadsRunner runner(specifications);
  CHECK_THROWS_WITH_AS(runner.run({}), doctest::Contains("packets that may wait have one target"), core::InternalError);
}

TEST_CASE("an idle thread looks again where many share a core, and sleeps at once where few do") {
  CHECK(polls_before_sleep(3, 2) == 0);
  CHECK(polls_before_sleep(5, 2) == 0);
  CHECK(polls_before_sleep(9, 2) > 0);
  CHECK(polls_before_sleep(65, 64) == 0);
  CHECK(polls_before_sleep(3, 0) > 0);
}

TEST_CASE("an idle thread whose long yields let others run sleeps at once for a while") {
  constexpr std::uint64_t ms = 1'000'000;
  PollBackoff polls(4, 2);
  polls.yielded_long(100 * ms, 50 * ms);
  CHECK(polls.allowed() == 4);
  // Half of the processors have been ours.
  polls.yielded_long(110 * ms, 60 * ms);
  CHECK(polls.allowed() == 4);
  // Now less than 0.4 of them.
  polls.yielded_long(120 * ms, 67 * ms);
  for (std::uint32_t sleep = 0; sleep < PollBackoff::sleeps_at_once_max; ++sleep) {
    CHECK(polls.allowed() == 0);
    polls.end();
  }
  CHECK(polls.allowed() == 4);
  polls.end();
  CHECK(polls.allowed() == 4);
}

TEST_CASE("a mailbox smaller than the credits is found out") {
  ThreadsRunner runner(
      equal_nodes(5, {.small_slots = 1, .bulk_slots = 1, .bulk_payload_bytes = 200}, making<Requester>(50U, 40U)));
  CHECK_THROWS_WITH_AS(runner.run({}), doctest::Contains("credits leave room"), core::InternalError);
}

TEST_CASE("nodes compute alike, however the thread that starts them flushes to zero or rounds") {
  /// Halves the least normal number, and divides where rounding shows.
  class Halves : public ToyProgram {
   public:
    using ToyProgram::ToyProgram;
    bool work() override {
      volatile float least = std::numeric_limits<float>::min(), one = 1, three = 3;
      is_right_ = least / 2 > 0 && one / three > 0.33333332F;
      has_worked_ = true;
      return false;
    }
    bool is_right() const { return is_right_; }
    bool finished() const override { return has_worked_; }

   private:
    bool has_worked_ = false, is_right_ = false;
  };
  std::fenv_t usual;
  std::fegetenv(&usual);
  std::fenv_t other = usual;
  other.__mxcsr |= 0x8040U;  // flush to zero, denormals are zeros
  std::fesetenv(&other);
  std::fesetround(FE_DOWNWARD);
  ThreadsRunner runner(equal_nodes(3, {}, making<Halves>()));
  const RunEnd end = runner.run({});
  std::fesetenv(&usual);
  CHECK(end == RunEnd::finished);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(program_of<Halves>(runner, i).is_right());
  }
}

TEST_CASE("a memory is sealed before the run begins") {
  ThreadsRunner runner(equal_nodes(2, {}, making<ToyProgram>()));
  CHECK(runner.node(0).memory().sealed());
  CHECK(runner.node(0).memory().used()[Category::queues] == MemoryPlan(credit_table(2)).total());
}

TEST_CASE("a runner runs again, with what its programs have to do by then, and counts each run from zero") {
  constexpr std::uint32_t peers = 5, window = 2;
  for (const auto pool_threads : {std::optional<std::uint32_t>(), std::optional<std::uint32_t>(2)}) {
    ThreadsRunner runner(equal_nodes(peers, Requester::mailbox(peers, window), making<Requester>(7U, window)), std::nullopt,
                         nullptr, pool_threads);
    for (const std::uint32_t count : {7U, 0U, 30U, 1U}) {
      for (std::uint32_t i = 0; i < peers; ++i) {
        program_of<Requester>(runner, i).ask(count);
      }
      CHECK(runner.run({}) == RunEnd::finished);
      for (std::uint32_t i = 0; i < peers; ++i) {
        CHECK(runner.program(i).finished());
        CHECK(program_of<Requester>(runner, i).all_right());
        CHECK(runner.node(i).counters().sent[request].packets == std::uint64_t{count} * (peers - 1));
        CHECK(runner.node(i).counters().received[request].packets == std::uint64_t{count} * (peers - 1));
      }
    }
  }
}

TEST_CASE("a computer of nothing and a thread without a stack are refused") {
  CHECK_THROWS_AS(ThreadsRunner({}), core::InternalError);
  auto specifications = equal_nodes(1, {}, making<ToyProgram>());
  specifications[0].plan[Category::reserve] = thread_stack_bytes_min - 1;
  CHECK_THROWS_AS(ThreadsRunner{specifications}, core::InternalError);
}

TEST_CASE("sixty-four idle nodes burn no processor time while one works") {
  constexpr double work_seconds = 0.2;
  ThreadsRunner runner(equal_nodes(65, {.small_slots = 1}, making<OneWorks>(work_seconds)));
  // Nodes that spin would burn as much as the one that works, on two free cores; nodes that yield where other processes want the
  // cores cost little time, but some hundred thousand switches instead of some hundred. What starting and ending 65 threads costs
  // counts for neither: with the thread sanitizer, on a busy machine, it is more than the work.
  const long switches_before = thread_switches_now();
  CHECK(runner.run({}) == RunEnd::finished);
  CHECK(thread_switches_now() - switches_before < 8000);
  double waited_seconds = 0.0;
  for (std::uint32_t i = 0; i < 64; ++i) {
    CHECK(runner.node(i).counters().sleeps <= 2);
    waited_seconds += program_of<OneWorks>(runner, i).waited_seconds();
  }
  CHECK(waited_seconds < 0.5 * work_seconds);
}

TEST_CASE("busy, asleep and wall time of a node fit together") {
  ThreadsRunner runner(equal_nodes(3, {.small_slots = 1}, making<OneWorks>(0.05)));
  CHECK(runner.run({}) == RunEnd::finished);
  CHECK(runner.node(2).counters().busy_ns >= 50'000'000);
  CHECK(runner.node(0).counters().busy_ns < 50'000'000);
  for (std::uint32_t i = 0; i < 3; ++i) {
    const NodeCounters& counters = runner.node(i).counters();
    CHECK(counters.asleep_ns <= counters.wall_ns);
    CHECK(counters.quanta > 0);
  }
  CHECK(runner.node(0).counters().asleep_ns > 0);
}

}  // namespace
}  // namespace dmpc::tests::threads_runner_test
