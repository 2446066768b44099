#include "apps/show/trace/file.h"

#include <doctest/doctest.h>

#include <vector>

#include "tests/apps/show/trace/traced.h"
#include "tests/support/text.h"

namespace dmpc::apps::file_test {

using tests::contains;

TEST_CASE("a trace's file says which time it holds") {
  Traced traced(to_trace(Strategy::svm, RunnerKind::virtual_time));
  const auto window = [&](const std::string& text) {
    traced.options.trace.window = parse_trace_window(text);
    return traced.text();
  };
  CHECK(contains(traced.text(),
                 "\x52\x09window_ms\x32\x03"
                 "all"));
  CHECK(contains(window("1.5,"), "1.500 to the end"));
  CHECK(contains(window(",2"), "0.000 to 2.000"));
}

TEST_CASE("a scene's name may be anything, and is one line in a trace's file") {
  Traced traced(to_trace(Strategy::svm, RunnerKind::virtual_time));
  traced.options.picture.scene = "a\n\xff\tb";
  CHECK(contains(traced.text(), "a \xef\xbf\xbd b"));
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

TEST_CASE("of a trace that is spread, or has the last, it is said what is there") {
  CHECK(loss_note({}).empty());
  nodes::Trace trace{.events_lost = 1234, .times = nodes::RecordedTimes{.whole_from_ns = 2'500'000}};
  CHECK(contains(loss_note(trace), "all is there from 2.500 ms on, and 1,234 events before were forgotten; --trace-window"));
  trace.times = {.whole_until_ns = 1'000'000, .whole_from_ns = 9'000'000, .part_bits = 10, .period_bits = 14, .has_parts = true};
  CHECK(contains(loss_note(trace),
                 "all is there until 1.000 ms and from 9.000 ms on, in between of each 16.384 us the first 1.024 us, and 1,234 "
                 "events were forgotten"));
}

}  // namespace dmpc::apps::file_test
