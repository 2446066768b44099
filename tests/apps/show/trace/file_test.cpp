#include "apps/show/trace/file.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "tests/apps/show/trace/traced.h"
#include "tests/support/text.h"

namespace dmpc::apps::file_test {

using tests::contains;

TEST_CASE("a trace's file says which time and nodes it holds") {
  Traced traced(to_trace(Strategy::svm, RunnerKind::virtual_time));
  CHECK(contains(traced.text(".json"), "\"window_ms\":\"all\",\n\"recorded_nodes\":\"all\""));
  traced.options.trace.window = parse_trace_window("1.5,");
  traced.options.trace.nodes = parse_trace_nodes("0,1-2,host");
  CHECK(contains(traced.text(".paje"), "# window_ms: 1.500 to the end\n# recorded_nodes: 0, 1 to 2, host\n"));
  traced.options.trace.window = parse_trace_window(",2");
  traced.options.trace.nodes = parse_trace_nodes("host");
  CHECK(contains(traced.text(".paje"), "# window_ms: 0.000 to 2.000\n# recorded_nodes: host\n"));
}

TEST_CASE("a scene's name may be anything, and a trace's file is whole") {
  Traced traced(to_trace(Strategy::svm, RunnerKind::virtual_time));
  traced.options.picture.scene = "a\n\xff\tb";
  CHECK(nlohmann::json::parse(traced.text(".json"))["otherData"]["scene"] == "a \xef\xbf\xbd b");
  CHECK(contains(traced.text(".paje"), "# scene: a \xff b\n"));
}

TEST_CASE("a trace of nothing is called empty, and one of an activity or a message, or that had no room for them, is not") {
  nodes::Trace trace{.nodes = std::vector<nodes::TraceNode>(2)};
  CHECK(contains(empty_note(trace), "the trace is empty"));
  trace.messages.emplace_back();
  CHECK(empty_note(trace).empty());
  trace.messages.clear();
  trace.nodes[1].spans.emplace_back();
  CHECK(empty_note(trace).empty());
  CHECK(empty_note({.events_lost = 1}).empty());
}

TEST_CASE("what was lost is said with its count and its time") {
  CHECK(loss_note({}, {}).empty());
  const std::string note = loss_note({.events_lost = 12'345, .lost_from_ns = 2'500'000}, {});
  CHECK(contains(note, "12,345 events from 2.500 ms on"));
  CHECK(contains(note, "--trace-every"));
  CHECK_FALSE(contains(loss_note({.events_lost = 1}, {.every = 2}), "--trace-every"));
}

TEST_CASE("of a trace that is spread, or has the last, it is said what is there") {
  nodes::Trace trace{.events_lost = 1234, .times = nodes::RecordedTimes{.whole_from_ns = 2'500'000}};
  CHECK(contains(loss_note(trace, {}), "all is there from 2.500 ms on, and 1,234 events before were forgotten; --trace-window"));
  trace.times = {.whole_until_ns = 1'000'000, .whole_from_ns = 9'000'000, .part_bits = 10, .period_bits = 14, .has_parts = true};
  CHECK(contains(loss_note(trace, {}),
                 "all is there until 1.000 ms and from 9.000 ms on, in between of each 16.384 us the first 1.024 us, and 1,234 "
                 "events were forgotten"));
}

}  // namespace dmpc::apps::file_test
