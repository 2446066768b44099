// Chains of causes so short that they can be told on paper, and long ones, which add up.
#include "nodes/virtual/path_finder.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <optional>
#include <random>
#include <vector>

#include "nodes/observers/wait_log.h"
#include "tests/nodes/scripted_machine.h"

namespace dmpc::tests::path_finder_test {
namespace {

using namespace nodes;

/// A run whose paths are followed, with all its waits.
struct WorkerRun {
  ScriptedRun run;
  WaitRecord waits;

  const PathTimes& path() const { return run.report.critical_path->times; }
};

WorkerRun follow(const std::vector<Script>& scripts, const Machine& machine = toy_model()) {
  WaitLog log(static_cast<std::uint32_t>(scripts.size()), 1U << 20U);
  WorkerRun followed{run_scripts(scripts, machine, &log), {}};
  followed.waits = log.take(1U << 20U);
  return followed;
}

/// Node 0 computes for 2 us, asks node 1 for a page by an interrupt, and computes for 5 us when it has it; node 1 serves it for
/// 3 us, in the midst of 300 us of its own or, with none, while it has nothing to do.
std::vector<Script> one_page(std::uint64_t busy) {
  return {{.quanta = {{2, {{1, urgent}}}}, .reactions = {{pong, {5}}}, .packets_awaited = 1},
          {.quanta = {{busy}}, .reactions = {{urgent, {3, {{0, pong, long_bytes}}}}}, .packets_awaited = 1},
          {}};
}

/// Up to 6 nodes that compute, send letters and ask each other.
std::vector<Script> random_scripts(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto count = static_cast<std::uint32_t>(2 + random() % 5);
  std::vector<Script> scripts(count + 1);
  for (std::uint32_t node = 0; node < count; ++node) {
    for (std::uint64_t quantum = random() % 5; quantum > 0; --quantum) {
      Act act{.operations = random() % 200};
      for (std::uint64_t letter = random() % 3; letter > 0; --letter) {
        const auto target = static_cast<std::uint32_t>(random() % count);
        const bool asks = random() % 2 == 0 && target != node;
        act.letters.push_back({target, asks ? urgent : ping, random() % 2 == 0 ? short_bytes : long_bytes});
      }
      scripts[node].quanta.push_back(act);
    }
    scripts[node].reactions[ping] = {random() % 50};
    scripts[node].reactions[urgent] = {random() % 50, {{(node + 1) % count, pong, long_bytes}}};
    scripts[node].reactions[pong] = {random() % 100};
  }
  return scripts;
}

/// The messages on the way back to the start, by the waits that led there.
std::uint64_t messages_back_from(const WaitRecord& record, ProgramPoint at) {
  std::uint64_t messages = 0;
  for (;;) {
    std::optional<Waited> last;
    for (const Waited& wait : record.waits) {
      if (wait.node == at.node && wait.end_ns <= at.time_ns) {
        last = wait;  // in order of time
      }
    }
    if (!last) {
      return messages;
    }
    CHECK(last->from.time_ns <= last->end_ns);
    messages += last->request ? 2 : 1;
    at = last->from;
  }
}

}  // namespace

TEST_CASE("the critical path of two nodes and one page is its request, service and reply between what the requester computes") {
  const WorkerRun followed = follow(one_page(0));
  const PathTimes& path = followed.path();
  CHECK(path.computing_ns == 2000 + 5000);
  CHECK(path.sending_ns == 3 + 11);
  CHECK(path.travelling_ns == (50 + 100 + 20 * 2) + (500 + 100 + 200 * 3));
  CHECK(path.serving_ns == 7 + 100'000 + 3000);
  CHECK(path.receiving_ns == 13);
  CHECK(path.service_busy_ns == 0);
  CHECK(path.links_ns == 0);
  CHECK(path.messages == 2);
  CHECK(path.by_kind_ns[urgent] == 3 + (50 + 100 + 40) + 103'007);
  CHECK(path.by_kind_ns[pong] == 11 + (500 + 100 + 600) + 13);
  CHECK(path.total_ns() == followed.run.report.total_ns);
}

TEST_CASE("a wait for a page says who sent what led to it, and when") {
  const WorkerRun followed = follow(one_page(0));
  REQUIRE(followed.waits.waits.size() == 1);
  const Waited& wait = followed.waits.waits.front();
  CHECK(wait.node == NodeId{0});
  CHECK(wait.peer == NodeId{1});
  CHECK(wait.kind == pong);
  CHECK(wait.request == urgent);
  CHECK(wait.begin_ns == 2003);
  CHECK(wait.left_ns == 2003 + 190 + 103'007 + 11);
  CHECK(wait.end_ns == wait.left_ns + 1200);
  CHECK(wait.from.node == NodeId{0});
  CHECK(wait.from.time_ns == 2003);
}

TEST_CASE("where the home computes longest, the critical path is what it computes and what was service while busy of that") {
  const WorkerRun followed = follow(one_page(300));
  CHECK(followed.path().computing_ns == 300'000);
  CHECK(followed.path().service_busy_ns == 103'007 + 11);
  CHECK(followed.path().messages == 0);
  CHECK(followed.path().total_ns() == followed.run.report.total_ns);
}

TEST_CASE("a request that stands behind another's service leads back to that one") {
  std::vector<Script> scripts(4);
  scripts[0] = {.quanta = {{2, {{2, urgent}}}}, .reactions = {{pong, {5}}}, .packets_awaited = 1};
  scripts[1] = {.quanta = {{3, {{2, urgent}}}}, .reactions = {{pong, {5}}}, .packets_awaited = 1};
  scripts[2] = {.reactions = {{urgent, {3, {{0, pong}}}}}, .packets_awaited = 2};
  scripts[2].reactions[urgent].letters = {{0, pong}, {1, pong}};
  scripts[0].packets_awaited = scripts[1].packets_awaited = 2;
  const WorkerRun followed = follow(scripts);
  CHECK(followed.path().computing_ns == 2000 + 5000);
  CHECK(followed.path().serving_ns == 2 * 103'007);
  CHECK(followed.path().total_ns() == followed.run.report.total_ns);
}

TEST_CASE("links that others hold are on the critical path by name") {
  const std::vector<Script> scripts = {{.quanta = {{1, {{2, ping, long_bytes}}}}},
                                       {.quanta = {{1, {{2, ping, long_bytes}}}}},
                                       {.reactions = {{ping, {4}}}, .packets_awaited = 2},
                                       {}};
  Machine machine = toy_model();
  machine.has_memory_port = true;
  const WorkerRun followed = follow(scripts, machine);
  CHECK(followed.path().total_ns() == followed.run.report.total_ns);
  CHECK(followed.run.report.links.wait_ns > 0);
}

TEST_CASE("in any run the critical path adds up to its time, and the waits lead back over as many messages to its start") {
  int led_back = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    CAPTURE(seed);
    const std::vector<Script> scripts = random_scripts(seed);
    Machine machine = toy_model(TopologyKind::torus);
    machine.service_ns = seed % 2 == 0 ? 100'000 : 0;
    const WorkerRun followed = follow(scripts, machine);
    const PathTimes& path = followed.path();
    const std::uint64_t total_ns = followed.run.report.total_ns;
    CHECK(path.total_ns() == total_ns);
    CHECK(std::accumulate(path.by_kind_ns.begin(), path.by_kind_ns.end(), std::uint64_t{0}) ==
          total_ns - path.computing_ns - path.service_busy_ns);
    const ProgramPoint from = followed.run.report.critical_path->from;
    if (from.time_ns == total_ns) {  // a program was the last, not a service
      CHECK(messages_back_from(followed.waits, from) == path.messages);
      ++led_back;
    }
  }
  CHECK(led_back > 50);
}

TEST_CASE("an observer is told waits that add up to those of each node, by the packets that end them") {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const WorkerRun followed = follow(random_scripts(seed));
    const std::vector<VirtualTimes>& all = followed.run.report.nodes;
    for (std::uint32_t node = 0; node < all.size(); ++node) {
      std::array<std::uint64_t, packet_kind_count> waited{};
      for (const Waited& wait : followed.waits.waits) {
        waited.at(wait.kind) += wait.node == NodeId{node} ? wait.own_ns : 0;
      }
      CHECK(waited == all[node].waiting_ns);
    }
  }
}

TEST_CASE("a run is the same whether paths are followed or not") {
  const std::vector<Script> scripts = one_page(40);
  const VirtualReport plain = run_scripts(scripts).report, followed = follow(scripts).run.report;
  CHECK(plain.hash == followed.hash);
  CHECK(plain.total_ns == followed.total_ns);
  CHECK_FALSE(plain.critical_path.has_value());
}

}  // namespace dmpc::tests::path_finder_test
