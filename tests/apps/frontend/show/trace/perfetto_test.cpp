#include "apps/frontend/show/trace/perfetto.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "apps/frontend/show/trace/wire.h"
#include "core/trace/charge.h"
#include "tests/apps/show/trace/traced.h"
#include "tests/support/child_process.h"
#include "tests/support/text.h"

namespace dmpc::apps::perfetto_test {

using tests::ChildProcess;
using tests::contains;
using tests::TemporaryFolder;

namespace {

/// What the compiler of Protocol Buffers makes of a trace: each field as a line, its status in front.
std::string decoded(const std::string& bytes) {
  const TemporaryFolder folder;
  tests::write_text(folder / "a.pftrace", bytes);
  ChildProcess shell({"/bin/sh", "-c", "exec protoc --decode=Trace -I \"$1\" \"$1/perfetto.proto\" < \"$2\"", "sh",
                      DMPC_SOURCE_DIR "/tests/apps/frontend/show/trace", (folder / "a.pftrace").string()});
  const int status = shell.status();
  CHECK_MESSAGE(status == 0, shell.errors());
  return shell.output();
}

/// What stands behind each occurrence of a field's name, to the end of the line; with `indentation` in front as it is written.
std::vector<std::string> values(const std::string& text, const std::string& field, const std::string& indentation = " ") {
  std::vector<std::string> found;
  const std::string beginning = indentation + field + ": ";
  for (std::size_t at = text.find(beginning); at != std::string::npos; at = text.find(beginning, at + 1)) {
    const std::size_t begin = at + beginning.size();
    found.push_back(text.substr(begin, text.find('\n', begin) - begin));
  }
  return found;
}

std::string value(const std::string& text, const std::string& field, const std::string& indentation = " ") {
  const std::vector<std::string> all = values(text, field, indentation);
  return all.empty() ? "" : all.front();
}

std::vector<std::string> packets(const std::string& text) {
  std::vector<std::string> found;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.size(), text.find("\n}\n", at) + 3);
    found.push_back(text.substr(at, end - at));
    at = end;
  }
  return found;
}

/// Packets of one type of event.
std::vector<std::string> events(const std::vector<std::string>& packets, const std::string& type) {
  std::vector<std::string> found;
  std::copy_if(packets.begin(), packets.end(), std::back_inserter(found),
               [&](const std::string& packet) { return value(packet, "type") == type; });
  return found;
}

/// In front of an event's own fields, and not of its arguments'.
constexpr const char* of_event = "\n    ";

/// How long the slices last of each name's number, together; each ends before what it lies on.
std::map<std::string, std::uint64_t> durations(const std::vector<std::string>& packets) {
  std::map<std::string, std::vector<std::pair<std::string, std::uint64_t>>> open;  // names and beginnings, by track
  std::map<std::string, std::uint64_t> sums;
  for (const std::string& packet : packets) {
    const std::string type = value(packet, "type");
    if (type == "TYPE_SLICE_BEGIN") {
      open[value(packet, "track_uuid")].emplace_back(value(packet, "name_iid", of_event),
                                                     std::stoull(value(packet, "timestamp")));
    } else if (type == "TYPE_SLICE_END") {
      auto& stack = open[value(packet, "track_uuid")];
      REQUIRE_FALSE(stack.empty());
      sums[stack.back().first] += std::stoull(value(packet, "timestamp")) - stack.back().second;
      stack.pop_back();
    }
  }
  for (const auto& [track, stack] : open) {
    CHECK(stack.empty());
  }
  return sums;
}

std::uint64_t span_count(const nodes::Trace& trace) {
  std::uint64_t sum = 0;
  for (const nodes::TraceNode& node : trace.nodes) {
    sum += node.spans.size();
  }
  return sum;
}

std::uint64_t level_count(const nodes::Trace& trace) {
  std::uint64_t sum = 0;
  for (const nodes::TraceNode& node : trace.nodes) {
    sum += node.levels.size();
  }
  return sum;
}

/// How long this activity lasts at all nodes together.
std::uint64_t duration_ns(const nodes::Trace& trace, SpanName name) {
  std::uint64_t sum_ns = 0;
  for (const nodes::TraceNode& node : trace.nodes) {
    for (const nodes::TraceSpan& span : node.spans) {
      sum_ns += name_of(span) == name ? span.end_ns - span.begin_ns : 0;
    }
  }
  return sum_ns;
}

/// What is written of one span of the second of three nodes.
std::string written(const nodes::TraceSpan& span) {
  nodes::Trace trace{.nodes = std::vector<nodes::TraceNode>(4)};
  trace.nodes[1].spans.push_back(span);
  const char* const kinds[] = {"page_request", "page_reply"};
  std::ostringstream output;
  write_perfetto({.trace = trace, .kind_names = kinds, .width = 10, .clock = "virtual time", .remarks = {}}, output);
  return decoded(output.str());
}

}  // namespace

TEST_CASE("Protocol Buffers read a Perfetto trace, and find in it all nodes, slices, messages, waits and levels") {
  for (const Strategy strategy : {Strategy::svm, Strategy::dataflow, Strategy::replicated}) {
    for (const RunnerKind runner : {RunnerKind::threads, RunnerKind::virtual_time}) {
      Traced traced(to_trace(strategy, runner));
      const std::string text = decoded(traced.text());
      const std::vector<std::string> all = packets(text);
      const std::uint64_t sent = nodes::total(account_of(traced.report).sent).packets;
      const std::uint64_t faults = strategy == Strategy::svm ? std::get<svm::Report>(traced.report).pages().faults : 0;
      CHECK(values(text, "process_name") ==
            std::vector<std::string>{"\"node 0\"", "\"node 1\"", "\"node 2\"", "\"host\"", "\"run\""});
      CHECK(events(all, "TYPE_SLICE_BEGIN").size() == span_count(traced.trace) + faults + 1);
      CHECK(events(all, "TYPE_SLICE_END").size() == span_count(traced.trace) + faults + 1);
      CHECK(events(all, "TYPE_COUNTER").size() == level_count(traced.trace));
      const std::vector<std::string> begun = values(text, "flow_ids"), ended = values(text, "terminating_flow_ids");
      CHECK(begun.size() == sent);
      CHECK(std::set(begun.begin(), begun.end()).size() == sent);
      CHECK(std::set(ended.begin(), ended.end()) == std::set(begun.begin(), begun.end()));
      for (std::size_t i = 0; i < 70; ++i) {
        CHECK_FALSE(contains(text, "\n  " + std::to_string(i) + ": "));  // no field but those of Perfetto
      }
    }
  }
}

TEST_CASE("slices of a Perfetto trace in virtual time last as long as the activities did, to the nanosecond") {
  for (const Strategy strategy : {Strategy::svm, Strategy::dataflow}) {
    Traced traced(to_trace(strategy, RunnerKind::virtual_time));
    std::map<std::string, std::uint64_t> sums = durations(packets(decoded(traced.text())));
    for (std::size_t i = 0; i < span_names.size(); ++i) {
      CHECK(sums[std::to_string(i + 1)] == duration_ns(traced.trace, static_cast<SpanName>(i)));
    }
  }
}

TEST_CASE("a Perfetto trace is in order of time, and each flow begins before it ends") {
  Traced traced(to_trace(Strategy::svm, RunnerKind::virtual_time));
  std::uint64_t last_ns = 0;
  bool is_in_run = true, ascends = true;
  std::set<std::string> begun;
  for (const std::string& packet : packets(decoded(traced.text()))) {
    const std::string time = value(packet, "timestamp");
    is_in_run = is_in_run && value(packet, "track_uuid") != "1";
    if (!time.empty() && !is_in_run) {
      ascends = ascends && std::stoull(time) >= last_ns;
      last_ns = std::stoull(time);
    }
    begun.insert(value(packet, "flow_ids"));
    CHECK(begun.contains(value(packet, "terminating_flow_ids")));
  }
  CHECK(ascends);
  CHECK(last_ns > 0);
}

TEST_CASE("a slice of a Perfetto trace says when, of which packet and for which pixel") {
  const std::string text = written({.begin_ns = 1'234'567,
                                    .end_ns = 2'000'000,
                                    .own_ns = 5,
                                    .item = 42,
                                    .depth = 300,
                                    .activity = nodes::Activity::receive,
                                    .packet = 1,
                                    .charged = 1U << static_cast<unsigned>(core::Charge::shading),
                                    .is_cut = true});
  std::string flat;
  for (const char c : text) {
    flat += c == '\n' || c == ' ' ? "" : std::string(1, c);
  }
  CHECK(contains(flat, "event_names{iid:2name:\"shade\"}"));
  CHECK(contains(flat, "debug_annotation_string_values{iid:2str:\"page_reply\"}"));
  CHECK(contains(flat, "timestamp:1234567"));
  CHECK(contains(flat, "timestamp:2000000"));
  CHECK(contains(flat, "type:TYPE_SLICE_BEGINname_iid:2track_uuid:2"));
  for (const char* const argument : {"name_iid:1uint_value:5}", "name_iid:2string_value_iid:2}", "name_iid:3uint_value:2}",
                                     "name_iid:4uint_value:4}", "name_iid:5uint_value:300}", "name_iid:6bool_value:true}"}) {
    CHECK_MESSAGE(contains(flat, std::string("debug_annotations{") + argument), argument);
  }
  CHECK(contains(flat, "debug_annotation_names{iid:5name:\"depth\"}"));
}

TEST_CASE("an interrupt's slice lies within what it interrupts, and what comes when both end begins behind both") {
  nodes::Trace trace{.nodes = std::vector<nodes::TraceNode>(2)};
  trace.nodes[0].spans = {{.begin_ns = 0, .end_ns = 20, .call = 1},
                          {.begin_ns = 5, .end_ns = 20, .call = 2, .activity = nodes::Activity::serve},
                          {.begin_ns = 20, .end_ns = 30, .call = 1, .activity = nodes::Activity::send},
                          {.begin_ns = 30, .end_ns = 30, .call = 3}};
  const char* const kinds[] = {"ray"};
  std::ostringstream output;
  write_perfetto({.trace = trace, .kind_names = kinds, .clock = "virtual time", .remarks = {}}, output);
  std::string order;
  for (const std::string& packet : packets(decoded(output.str()))) {
    if (value(packet, "track_uuid") == "1") {
      order += value(packet, "timestamp") + (value(packet, "type") == "TYPE_SLICE_BEGIN" ? "+ " : "- ");
    }
  }
  CHECK(order == "0+ 5+ 20- 20- 20+ 30- 30+ 30- ");
}

TEST_CASE("names in a Perfetto trace may be anything, and are UTF-8") {
  nodes::Trace trace{.nodes = std::vector<nodes::TraceNode>(2)};
  trace.nodes[0].level_names = {"\xff\"\n\\", ""};
  const char* const kinds[] = {"a\xc3"};
  std::ostringstream output;
  write_perfetto(
      {.trace = trace, .kind_names = kinds, .clock = "wall clock", .remarks = {{"scene", "</script>\xe2\x80\xa8\x80"}}}, output);
  const std::string text = decoded(output.str());
  CHECK(contains(text, R"(name: "\357\277\275\"\n\\")"));
  CHECK(contains(text, R"(name: "a\357\277\275")"));
  CHECK(contains(text, R"(string_value: "</script>\342\200\250\357\277\275")"));
}

TEST_CASE("a Perfetto trace that was thinned shows when it was recorded") {
  nodes::Trace trace{.nodes = std::vector<nodes::TraceNode>(2),
                     .events_lost = 3,
                     .times = nodes::RecordedTimes{
                         .whole_until_ns = 10, .whole_from_ns = 40, .part_bits = 2, .period_bits = 4, .has_parts = true}};
  trace.nodes[0].spans = {{.begin_ns = 0, .end_ns = 50}};
  std::ostringstream output;
  write_perfetto({.trace = trace, .kind_names = {}, .clock = "virtual time", .remarks = {}}, output);
  std::string order;
  for (const std::string& packet : packets(decoded(output.str()))) {
    if (value(packet, "track_uuid") == "4") {
      order += value(packet, "timestamp") + " ";
    }
  }
  CHECK(order == "0 10 16 20 32 36 40 50 ");
}

TEST_CASE("waits for pages that lie over each other have tracks of their own, and a track is used again") {
  Traced traced(to_trace(Strategy::svm, RunnerKind::virtual_time));
  const std::string text = decoded(traced.text());
  std::size_t tracks = 0;
  for (const std::string& name : values(text, "name")) {
    tracks += name == "\"waits for pages\"" ? 1 : 0;
  }
  CHECK(tracks >= 3);
  CHECK(tracks < std::get<svm::Report>(traced.report).pages().faults);
}

TEST_CASE("a number takes seven bits a byte, and a fixed one eight bytes") {
  WireMessage message;
  message.put(1, 127);
  message.put(1, 300);
  message.put(16, 0);
  message.put_fixed(2, 258);
  message.put_bytes(3, "ab");
  message.put(4, std::numeric_limits<std::uint64_t>::max());
  CHECK(message.bytes() == std::string_view("\x08\x7f\x08\xac\x02\x80\x01\x00\x11\x02\x01\0\0\0\0\0\0\x1a\x02"
                                            "ab\x20\xff\xff\xff\xff\xff\xff\xff\xff\xff\x01",
                                            32));
}

TEST_CASE("a Perfetto trace of nothing is whole, too") {
  const nodes::Trace nothing{.nodes = std::vector<nodes::TraceNode>(2)};
  std::ostringstream output;
  write_perfetto({.trace = nothing, .kind_names = {}, .clock = "wall clock", .remarks = {}}, output);
  CHECK(values(decoded(output.str()), "process_name").size() == 3);
}

}  // namespace dmpc::apps::perfetto_test
