#include "nodes/observers/trace.h"

#include <doctest/doctest.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/expect.h"
#include "nodes/program.h"

namespace dmpc::nodes::watch_trace_test {

namespace {

/// A program that has nothing but its levels.
class Gauge final : public Program {
 public:
  void receive(const Packet& /*packet*/) override {}
  bool work() override { return false; }
  bool finished() const override { return true; }
  std::string describe() const override { return ""; }
  Levels levels() const override { return {{"height", height}, {"depth", 7}}; }

  std::uint64_t height = 0;
};

/// Two nodes and a host that tell a recorder what the test says.
struct Reported {
  explicit Reported(const TraceChoice& choice = {}) : recorder(3, choice) {}

  void span(std::uint32_t node, std::uint64_t begin_ns, std::uint64_t end_ns, Activity activity = Activity::work,
            std::uint64_t call = 0) {
    recorder.ended({.node = NodeId{node}, .activity = activity, .call = call, .begin_ns = begin_ns, .end_ns = end_ns}, gauge);
  }
  void sends(std::uint32_t from, std::uint32_t to, std::uint64_t time_ns, std::uint64_t call = 0, PacketKind kind = 1) {
    recorder.sent({.node = NodeId{from},
                   .peer = NodeId{to},
                   .kind = kind,
                   .call = call,
                   .payload = payload(),
                   .times = {.sending_ns = time_ns}});
  }
  void receives(std::uint32_t at, std::uint32_t from, std::uint64_t time_ns, std::uint64_t call = 0, PacketKind kind = 1) {
    recorder.received({.node = NodeId{at},
                       .peer = NodeId{from},
                       .kind = kind,
                       .call = call,
                       .payload = payload(),
                       .times = {.received_ns = time_ns}});
  }
  std::span<const std::byte> payload() const { return std::as_bytes(std::span(words)); }

  TraceRecorder recorder;
  Gauge gauge;
  std::array<std::uint32_t, 2> words = {77, 5};
};

}  // namespace

TEST_CASE("nothing told is a trace of nothing") {
  const Trace trace = Reported().recorder.take();
  CHECK(trace.nodes.size() == 3);
  CHECK(trace.messages.empty());
  CHECK(trace.events_lost == 0);
}

TEST_CASE("a span has a bit for each class of operations that it was charged") {
  Reported reported;
  Span span{.node = NodeId{0}};
  span.before.count[3] = span.after.count[3] = 7;
  span.after.count[0] = 2;
  span.after.count[5] = 1;
  reported.recorder.ended(span, reported.gauge);
  CHECK(reported.recorder.take().nodes[0].spans.at(0).charged == 0b100001);
}

TEST_CASE("what begins first comes first, and an interrupt behind what it interrupts") {
  Reported reported;
  reported.span(0, 5, 8, Activity::serve, 2);
  reported.span(0, 5, 20, Activity::work, 1);
  reported.span(0, 0, 5, Activity::take_over);
  const std::vector<TraceSpan> spans = reported.recorder.take().nodes[0].spans;
  REQUIRE(spans.size() == 3);
  CHECK(spans[0].activity == Activity::take_over);
  CHECK(spans[1].activity == Activity::work);
  CHECK(spans[2].activity == Activity::serve);
}

TEST_CASE("a call has the item that it worked on, and an interrupt leaves it alone") {
  Reported reported;
  reported.recorder.worked({NodeId{1}, 42, 3});
  reported.span(1, 2, 3, Activity::serve, 2);
  reported.span(1, 0, 9, Activity::work, 1);
  reported.span(1, 9, 10, Activity::work, 3);
  const std::vector<TraceSpan> spans = reported.recorder.take().nodes[1].spans;
  CHECK(spans[0].item == 42);
  CHECK(spans[0].depth == 3);
  CHECK(spans[1].item == TraceSpan::no_item);
  CHECK(spans[2].item == TraceSpan::no_item);
}

TEST_CASE("a message is as long as its payload, an end that lasts and is not copied included") {
  Reported reported;
  for (const std::size_t immutable_bytes : {0U, 512U}) {
    reported.recorder.sent(
        {.node = NodeId{0}, .peer = NodeId{1}, .payload = reported.payload(), .immutable_bytes = immutable_bytes});
    reported.recorder.received(
        {.node = NodeId{1}, .peer = NodeId{0}, .payload = reported.payload(), .immutable_bytes = immutable_bytes});
  }
  const std::vector<TraceMessage> messages = reported.recorder.take().messages;
  REQUIRE(messages.size() == 2);
  CHECK(messages[0].bytes == 8);
  CHECK(messages[1].bytes == 520);
}

TEST_CASE("of one kind between two nodes the n-th packet received is the n-th sent") {
  Reported reported;
  reported.sends(0, 1, 10, 1);
  reported.sends(0, 1, 20, 2, 9);
  reported.sends(0, 1, 30, 3);
  reported.sends(1, 0, 15, 1);
  reported.receives(1, 0, 25, 4, 9);
  reported.receives(1, 0, 26, 5);
  reported.receives(1, 0, 40, 6);
  const std::vector<TraceMessage> messages = reported.recorder.take().messages;
  REQUIRE(messages.size() == 3);  // the one from node 1 was not received
  CHECK(messages[0].sent_ns == 10);
  CHECK(messages[0].received_ns == 26);
  CHECK(messages[0].received_call == 5);
  CHECK(messages[0].first_word == 77);
  CHECK(messages[0].bytes == 8);
  CHECK(messages[1].kind == 9);
  CHECK(messages[1].received_ns == 25);
  CHECK(messages[2].sent_call == 3);
  CHECK(messages[2].received_ns == 40);
}

TEST_CASE("a level is written where it changes") {
  Reported reported;
  reported.span(0, 0, 1);
  reported.span(0, 1, 2);
  reported.gauge.height = 3;
  reported.span(0, 2, 3, Activity::send);
  reported.span(0, 3, 4, Activity::receive);
  const TraceNode node = reported.recorder.take().nodes[0];
  CHECK(node.level_names == std::vector<std::string>{"height", "depth"});
  REQUIRE(node.levels.size() == 3);
  CHECK(node.levels[0].value == 0);
  CHECK(node.levels[1].value == 7);
  CHECK(node.levels[2].value == 3);
  CHECK(node.levels[2].time_ns == 4);
}

TEST_CASE("a window cuts what lies across its edges and leaves out what lies beyond") {
  Reported reported({.from_ns = 10, .to_ns = 20});
  reported.span(0, 0, 10);
  reported.span(0, 5, 15);
  reported.span(0, 15, 18);
  reported.span(0, 19, 30);
  reported.span(0, 20, 25);
  reported.sends(0, 1, 9);
  reported.sends(0, 1, 10);
  reported.sends(0, 1, 19);
  reported.receives(1, 0, 11);
  reported.receives(1, 0, 12);
  reported.receives(1, 0, 20);
  const Trace trace = reported.recorder.take();
  const std::vector<TraceSpan>& spans = trace.nodes[0].spans;
  REQUIRE(spans.size() == 3);
  CHECK(spans[0].begin_ns == 10);
  CHECK(spans[0].end_ns == 15);
  CHECK(spans[0].is_cut);
  CHECK_FALSE(spans[1].is_cut);
  CHECK(spans[2].end_ns == 20);
  CHECK(spans[2].is_cut);
  REQUIRE(trace.messages.size() == 1);
  CHECK(trace.messages[0].sent_ns == 10);
  CHECK(trace.messages[0].received_ns == 12);
  CHECK(trace.nodes[0].levels.front().time_ns == 10);
}

TEST_CASE("what a recorder on another rank has kept is taken over, with both ends of each message") {
  Reported here, elsewhere;
  elsewhere.gauge.height = 3;
  here.sends(0, 1, 10, 4);
  here.span(0, 5, 20, Activity::work, 4);
  elsewhere.receives(1, 0, 30, 7);
  elsewhere.span(1, 25, 40, Activity::receive, 7);
  here.recorder.add(elsewhere.recorder.bytes(), {});
  const Trace trace = here.recorder.take();
  REQUIRE(trace.messages.size() == 1);
  CHECK(trace.messages[0].sent_ns == 10);
  CHECK(trace.messages[0].received_ns == 30);
  CHECK(trace.messages[0].sent_call == 4);
  CHECK(trace.messages[0].received_call == 7);
  CHECK(trace.messages[0].first_word == 77);
  CHECK(trace.messages_moved == 0);
  REQUIRE(trace.nodes[1].spans.size() == 1);
  CHECK(trace.nodes[1].spans[0].begin_ns == 25);
  CHECK(trace.nodes[1].spans[0].end_ns == 40);
  CHECK(trace.nodes[1].level_names == std::vector<std::string>{"height", "depth"});
  REQUIRE(trace.nodes[1].levels.size() == 2);
  CHECK(trace.nodes[1].levels[0].value == 3);
  CHECK(trace.nodes[2].spans.empty());
}

TEST_CASE("times of another rank are corrected by its clock, which gains") {
  Reported here, elsewhere;
  elsewhere.span(1, 0, 1'010'000);
  elsewhere.sends(1, 2, 505'000);
  here.receives(2, 1, 600'000);
  // 1 % faster: set at the start, 10 us ahead 1 ms later.
  here.recorder.add(elsewhere.recorder.bytes(),
                    ClockDrift({5'000'000, 70, 5'000'000}, {6'000'000, 70 + 1'010'000, 6'000'000}, 5'000'000));
  const Trace trace = here.recorder.take();
  CHECK(trace.nodes[1].spans.at(0).begin_ns == 0);
  CHECK(trace.nodes[1].spans.at(0).end_ns == 1'000'000);
  CHECK(trace.nodes[1].levels.at(0).time_ns == 1'000'000);
  CHECK(trace.messages.at(0).sent_ns == 500'000);
}

TEST_CASE("a message that another rank's clock has received too early is received when it is sent, and counted") {
  Reported here, elsewhere;
  for (const std::uint64_t sent : {100, 200, 300}) {
    here.sends(0, 1, sent);
  }
  for (const std::uint64_t received : {90, 250, 260}) {
    elsewhere.receives(1, 0, received);
  }
  here.recorder.add(elsewhere.recorder.bytes(), {});
  const Trace trace = here.recorder.take();
  CHECK(trace.messages_moved == 2);
  CHECK(trace.moved_ns_max == 40);
  CHECK(trace.messages.at(0).received_ns == 100);
  CHECK(trace.messages.at(1).received_ns == 250);
  CHECK(trace.messages.at(2).received_ns == 300);
}

TEST_CASE("what a full recorder on another rank has lost is counted with what is lost here") {
  const TraceChoice choice = {.events_max = 60};
  Reported here(choice), elsewhere(choice);
  for (std::uint64_t call = 1; call <= 1000; ++call) {
    here.span(0, 10 * call + 5, 10 * call + 6);
    elsewhere.span(1, 10 * call, 10 * call + 1);
  }
  here.recorder.add(elsewhere.recorder.bytes(), {});
  const Trace trace = here.recorder.take();
  std::size_t kept = 0;
  for (const std::size_t node : {0, 1}) {
    CHECK_FALSE(trace.nodes[node].spans.empty());
    kept += trace.nodes[node].spans.size() + trace.nodes[node].levels.size();
  }
  CHECK(kept <= 2 * 60);
  CHECK(kept + trace.events_lost == 2 * (1000 + 2));
}

TEST_CASE("a full trace has the beginning, the end, and at all nodes the same parts of what is between") {
  Reported reported({.events_max = 3000});
  for (std::uint64_t call = 1; call <= 50'000; ++call) {
    reported.sends(0, 1, 16 * call, call);
    reported.receives(1, 0, 16 * call + 1, call);
    reported.span(0, 16 * call, 16 * call + 1, Activity::work, call);
    if (call % 8 == 0) {
      reported.span(1, 16 * call + 1, 16 * call + 2, Activity::receive, call);
    }
  }
  const Trace trace = reported.recorder.take();
  REQUIRE(trace.times);
  const RecordedTimes& times = *trace.times;
  CHECK(times.has_parts);
  CHECK(times.whole_until_ns > 16);
  CHECK(times.whole_from_ns < 800'000);
  CHECK(times.period_ns() <= 8000);  // a percent of the run
  const std::vector<TraceSpan>& spans = trace.nodes[0].spans;
  CHECK(spans.front().call == 1);
  CHECK(spans.back().call == 50'000);
  CHECK(spans.size() > 400);
  CHECK(spans.size() + trace.nodes[1].spans.size() + 2 * trace.messages.size() <= 3000);
  std::uint64_t expected = 0;
  for (std::uint64_t call = 1; call <= 50'000; ++call) {
    expected += times.has(16 * call) ? 1 : 0;
  }
  CHECK(spans.size() == expected);
  for (const TraceNode& node : trace.nodes) {
    for (const TraceSpan& span : node.spans) {
      CHECK(times.has(span.begin_ns));
    }
  }
}

TEST_CASE("a level that is told in a part that is left out is told again where the next begins") {
  Reported reported({.events_max = 1200});
  for (std::uint64_t call = 1; call <= 10'000; ++call) {
    reported.gauge.height = call / 100;
    reported.span(0, 16 * call, 16 * call + 1, Activity::work, call);
  }
  const Trace trace = reported.recorder.take();
  REQUIRE(trace.times);
  CHECK(trace.times->has_parts);
  std::uint64_t height = 0;
  auto level = trace.nodes[0].levels.begin();
  for (const TraceSpan& span : trace.nodes[0].spans) {
    for (; level != trace.nodes[0].levels.end() && level->time_ns <= span.end_ns; ++level) {
      height = level->number == 0 ? level->value : height;
    }
    CHECK(height == span.call / 100);
  }
}

TEST_CASE("a trace is never longer than it may be, however much happens at one time") {
  for (const std::uint64_t events_max : {1U, 2U, 7U, 100U}) {
    Reported reported({.events_max = events_max});
    for (std::uint64_t call = 1; call <= 2000; ++call) {
      reported.span(static_cast<std::uint32_t>(call % 3), call / 1000, call / 1000, Activity::work, call);
    }
    const Trace trace = reported.recorder.take();
    std::uint64_t count = 0;
    for (const TraceNode& node : trace.nodes) {
      count += node.spans.size() + node.levels.size();
    }
    CHECK(count <= events_max);
    CHECK(count + trace.events_lost == 2000 + 3 * 2);
  }
}

TEST_CASE("what was spread on two ranks has what both have in common") {
  Reported here({.events_max = 600}), elsewhere({.events_max = 600});
  for (std::uint64_t call = 1; call <= 4000; ++call) {
    here.span(0, 16 * call, 16 * call + 1, Activity::work, call);
    elsewhere.span(1, 64 * call, 64 * call + 1, Activity::work, call);
  }
  here.recorder.add(elsewhere.recorder.bytes(), {});
  const Trace trace = here.recorder.take();
  REQUIRE(trace.times);
  CHECK(trace.nodes[1].spans.back().call == 4000);
  for (const TraceNode& node : trace.nodes) {
    for (const TraceSpan& span : node.spans) {
      CHECK(trace.times->has(span.begin_ns));
    }
  }
}

TEST_CASE("a node that has told something on two ranks is an error") {
  Reported here, elsewhere;
  here.span(1, 0, 1);
  elsewhere.span(1, 2, 3);
  CHECK_THROWS_AS(here.recorder.add(elsewhere.recorder.bytes(), {}), core::InternalError);
}

TEST_CASE("a call beyond the 2^32nd has a number of its own") {
  constexpr std::uint64_t late = (std::uint64_t{1} << 32U) + 5;
  Reported reported;
  reported.span(0, 0, 10, Activity::work, 5);
  reported.sends(0, 1, 20, late);
  reported.span(0, 20, 30, Activity::work, late);
  reported.receives(1, 0, 40, late + 1);
  reported.span(1, 40, 50, Activity::receive, late + 1);
  const Trace trace = reported.recorder.take();
  REQUIRE(trace.nodes[0].spans.size() == 2);
  CHECK(trace.nodes[0].spans[1].call == late);
  REQUIRE(trace.messages.size() == 1);
  CHECK(trace.messages[0].sent_call == late);
  CHECK(trace.messages[0].received_call == late + 1);
}

}  // namespace dmpc::nodes::watch_trace_test
