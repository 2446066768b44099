#include "nodes/observer.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "nodes/threads/threads_runner.h"
#include "tests/nodes/scripted_machine.h"

namespace dmpc::tests::observer_test {
namespace {

using namespace nodes;

/// Writes down what it is told; each node's on its own, since several may tell at a time.
class Scribe final : public Observer {
 public:
  explicit Scribe(std::size_t peer_count)
      : spans(peer_count), sent_by(peer_count), received_by(peer_count), waits_of(peer_count) {}

  void ended(const Span& span, const Program& /*program*/) override { spans[index_of(span.node)].push_back(span); }
  void sent(const Passing& packet) override { sent_by[index_of(packet.node)].push_back(packet); }
  void received(const Passing& packet) override { received_by[index_of(packet.node)].push_back(packet); }
  void waited(const Waited& wait) override { waits_of[index_of(wait.node)].push_back(wait); }

  std::vector<std::vector<Span>> spans;
  std::vector<std::vector<Passing>> sent_by, received_by;  ///< whose payloads are gone
  std::vector<std::vector<Waited>> waits_of;
};

/// Node 0 computes for 2 us, then sends `letter` to node 1, which computes for `busy` us from the start.
std::vector<Script> one_letter(const Letter& letter, std::uint64_t busy) {
  return {{.quanta = {{2, {letter}}}}, {.quanta = {{busy}}, .reactions = {{ping, {4}}, {urgent, {}}}, .packets_awaited = 1}, {}};
}

Scribe watch(const std::vector<Script>& scripts) {
  Scribe scribe(scripts.size());
  run_scripts(scripts, toy_model(), &scribe);
  return scribe;
}

}  // namespace

TEST_CASE("an observer sees when a message passed each part of its way") {
  const Scribe scribe = watch(one_letter({1, ping, short_bytes}, 0));
  REQUIRE(scribe.sent_by[0].size() == 1);
  REQUIRE(scribe.received_by[1].size() == 1);
  const Passing& sent = scribe.sent_by[0].front();
  CHECK(sent.peer == NodeId{1});
  CHECK(sent.times.sending_ns == 2000);
  CHECK(sent.times.left_ns == 2003);
  const MessageTimes& times = scribe.received_by[1].front().times;
  CHECK(times.left_ns == 2003);
  CHECK(times.entered_ns == 2053);
  CHECK(times.links_ns == 0);
  CHECK(times.arrived_ns == 2053 + 100 + 40);
  CHECK(times.received_ns == 2193 + 7);
}

TEST_CASE("an observer sees how long a message waits for links") {
  const std::vector<Script> scripts = {
      {.quanta = {{0, {{2, ping, long_bytes}}}}}, {.quanta = {{0, {{2, ping, long_bytes}}}}}, {.packets_awaited = 2}, {}};
  Scribe scribe(scripts.size());
  Machine machine = toy_model();
  machine.has_memory_port = true;
  const ScriptedRun run = run_scripts(scripts, machine, &scribe);
  REQUIRE(scribe.received_by[2].size() == 2);
  CHECK(scribe.received_by[2][0].times.links_ns == 0);
  CHECK(scribe.received_by[2][1].times.links_ns == run.report.links.wait_ns);
  CHECK(run.report.links.wait_ns > 0);
}

TEST_CASE("an observer sees a quantum, its sending, and the taking over of what comes to an idle node") {
  const Scribe scribe = watch(one_letter({1, ping, short_bytes}, 0));
  REQUIRE(scribe.spans[0].size() >= 2);
  const Span& work = scribe.spans[0][0];
  CHECK(work.activity == Activity::work);
  CHECK(work.begin_ns == 0);
  CHECK(work.end_ns == 2000);
  CHECK(work.own_ns == 2000);
  CHECK(work.after.count[0] - work.before.count[0] == 2);
  CHECK(scribe.spans[0][1].activity == Activity::send);
  CHECK(scribe.spans[0][1].end_ns == 2003);
  CHECK(scribe.spans[0][1].call == work.call);
  CHECK(scribe.sent_by[0].front().call == work.call);
  const std::vector<Span>& at = scribe.spans[1];
  const auto take_over = std::find_if(at.begin(), at.end(), [](const Span& s) { return s.activity == Activity::take_over; });
  REQUIRE(take_over != at.end());
  CHECK(take_over->begin_ns == 2193);
  CHECK(take_over->end_ns == 2200);
  REQUIRE(take_over + 1 != at.end());
  CHECK((take_over + 1)->activity == Activity::receive);
  CHECK((take_over + 1)->packet == ping);
  CHECK((take_over + 1)->end_ns == 6200);
  CHECK((take_over + 1)->call == scribe.received_by[1].front().call);
}

TEST_CASE("an observer sees an interrupt's service within the quantum that it prolongs") {
  const Scribe scribe = watch(one_letter({1, urgent, short_bytes}, 10));
  const std::vector<Span>& at = scribe.spans[1];
  REQUIRE(at.size() >= 2);
  CHECK(at[0].activity == Activity::serve);
  CHECK(at[0].begin_ns == 2193);
  CHECK(at[0].end_ns == 2193 + 7 + 100'000);
  CHECK(at[1].activity == Activity::work);
  CHECK(at[1].begin_ns == 0);
  CHECK(at[1].end_ns == 10'000 + 100'007);
  CHECK(at[1].own_ns == 10'000);
}

TEST_CASE("an observer of threads sees each call after what it sends and receives, in order of time") {
  const std::vector<Script> scripts = one_letter({1, ping, short_bytes}, 1);
  Scribe scribe(scripts.size());
  ThreadsRunner runner(specifications_of(scripts), std::nullopt, &scribe);
  CHECK(runner.run({}) == RunEnd::finished);
  REQUIRE(scribe.sent_by[0].size() == 1);
  REQUIRE(scribe.received_by[1].size() == 1);
  REQUIRE(scribe.spans[0].size() >= 1);
  const Span& work = scribe.spans[0].front();
  const Passing& sent = scribe.sent_by[0].front();
  CHECK(sent.call == work.call);
  CHECK(work.begin_ns <= sent.times.sending_ns);
  CHECK(sent.times.sending_ns <= work.end_ns);
  CHECK(sent.times.sending_ns <= scribe.received_by[1].front().times.received_ns);
  for (const std::vector<Span>& spans : scribe.spans) {
    CHECK(std::is_sorted(spans.begin(), spans.end(), [](const Span& a, const Span& b) { return a.end_ns < b.begin_ns; }));
  }
}

TEST_CASE("an observer sees how long a node has nothing to do, and the packet that ends it") {
  const std::vector<Waited> waits = watch(one_letter({1, ping, short_bytes}, 0)).waits_of[1];
  REQUIRE(waits.size() == 1);
  CHECK(waits[0].peer == NodeId{0});
  CHECK(waits[0].kind == ping);
  CHECK(waits[0].begin_ns == 0);
  CHECK(waits[0].end_ns == 2193);
  CHECK(waits[0].own_ns == 2193);
}

TEST_CASE("an observer of threads sees waits between a node's calls, which urgent packets do not end") {
  const std::vector<Script> scripts = {
      {.quanta = {{0, {{1, urgent}}}}, .reactions = {{pong, {0, {{1, ping}}}}}, .packets_awaited = 1},
      {.reactions = {{urgent, {0, {{0, pong}}}}}, .packets_awaited = 2},
      {}};
  Scribe scribe(scripts.size());
  ThreadsRunner runner(specifications_of(scripts), std::nullopt, &scribe);
  CHECK(runner.run({}) == RunEnd::finished);
  for (const Waited& wait : scribe.waits_of[1]) {
    CHECK(wait.kind == ping);
    CHECK(wait.peer == NodeId{0});
    CHECK(wait.own_ns <= wait.end_ns - wait.begin_ns);
    const std::vector<Span>& at = scribe.spans[1];
    CHECK(std::any_of(at.begin(), at.end(), [&](const Span& span) { return span.end_ns == wait.begin_ns; }));
    CHECK(std::any_of(at.begin(), at.end(), [&](const Span& span) {
      return span.begin_ns == wait.end_ns && span.activity == Activity::receive && span.packet == ping;
    }));
  }
  CHECK(scribe.waits_of[1].size() <= 1);
}

TEST_CASE("an observer of threads sees a packet when its program sends it, however long chaos holds it back") {
  const std::vector<Script> scripts = {
      {.quanta = {{0, {{1}}}, {0, {{1}}}, {0, {{1}}}, {0, {}}, {0, {}}, {0, {}}, {0, {}}}}, {.packets_awaited = 3}, {}};
  Scribe scribe(scripts.size());
  ThreadsRunner runner(disturbed(specifications_of(scripts)), Chaos{.seed = 1, .held_percent = 100, .shrinks_credits = false},
                       &scribe);
  CHECK(runner.run({}) == RunEnd::finished);
  CHECK(runner.node(0).counters().held == 3);
  REQUIRE(scribe.sent_by[0].size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    const Span& work = scribe.spans[0].at(i);
    const Passing& sent = scribe.sent_by[0][i];
    CHECK(sent.call == work.call);
    CHECK(work.begin_ns <= sent.times.sending_ns);
    CHECK(sent.times.sending_ns <= work.end_ns);
    CHECK(sent.times.sending_ns <= scribe.received_by[1].at(i).times.received_ns);
  }
}

}  // namespace dmpc::tests::observer_test
