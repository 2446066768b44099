#include "apps/edge/show/trace/chrome.h"

#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "core/trace/charge.h"
#include "tests/apps/show/trace/traced.h"
#include "tests/support/text.h"

namespace dmpc::apps::chrome_test {

using tests::contains;

namespace {

/// Events of one phase.
std::vector<nlohmann::json> events(const nlohmann::json& trace, const std::string& phase) {
  std::vector<nlohmann::json> found;
  for (const nlohmann::json& event : trace["traceEvents"]) {
    if (event["ph"] == phase) {
      found.push_back(event);
    }
  }
  return found;
}

std::set<int> ids(const std::vector<nlohmann::json>& events) {
  std::set<int> found;
  for (const nlohmann::json& event : events) {
    found.insert(event["id"].get<int>());
  }
  return found;
}

std::uint64_t packets_sent(const Report& report) { return nodes::total(account_of(report).sent).packets; }

/// Three nodes of which one has done this.
std::string written(const nodes::TraceSpan& span) {
  nodes::Trace trace{.nodes = std::vector<nodes::TraceNode>(4)};
  trace.nodes[1].spans.push_back(span);
  const char* const kinds[] = {"page_request", "page_reply"};
  std::ostringstream output;
  write_chrome({.trace = trace, .kind_names = kinds, .width = 10, .clock = "virtual time", .remarks = {{"scene", "a\"b\\c\nd"}}},
               output);
  return output.str();
}

}  // namespace

TEST_CASE("a Chrome trace is JSON whose times never decrease, and says its clock") {
  for (const RunnerKind runner : {RunnerKind::threads, RunnerKind::virtual_time}) {
    const nlohmann::json trace = nlohmann::json::parse(Traced(to_trace(Strategy::svm, runner)).text(".json"));
    CHECK(trace["otherData"]["clock"] == (runner == RunnerKind::threads ? "wall clock" : "virtual time"));
    CHECK(trace["otherData"].contains("run_hash") == (runner == RunnerKind::virtual_time));
    double last = 0;
    bool ascends = true;
    for (const nlohmann::json& event : trace["traceEvents"]) {
      ascends = ascends && (event["ph"] == "M" || event["ts"] >= last);
      last = event.value("ts", last);
    }
    CHECK(ascends);
    CHECK(events(trace, "M").size() == 3 * 4);
    CHECK(events(trace, "X").size() > 100);
    CHECK(events(trace, "C").size() > 10);
  }
}

TEST_CASE("every flow of a Chrome trace has a beginning and an end, and is a packet") {
  for (const Strategy strategy : {Strategy::svm, Strategy::dataflow, Strategy::replicated}) {
    Traced traced(to_trace(strategy, RunnerKind::virtual_time));
    const nlohmann::json trace = nlohmann::json::parse(traced.text(".json"));
    const std::vector<nlohmann::json> begins = events(trace, "s"), ends = events(trace, "f");
    CHECK(begins.size() == packets_sent(traced.report));
    CHECK(ends.size() == begins.size());
    CHECK(ids(begins).size() == begins.size());
    CHECK(ids(ends) == ids(begins));
  }
}

TEST_CASE("a node waits for each page that it asked for from the request to the reply") {
  Traced traced(to_trace(Strategy::svm, RunnerKind::virtual_time));
  const nlohmann::json trace = nlohmann::json::parse(traced.text(".json"));
  const std::vector<nlohmann::json> begins = events(trace, "b"), ends = events(trace, "e");
  CHECK(begins.size() == std::get<svm::Report>(traced.report).pages().faults);
  CHECK(ids(ends) == ids(begins));
  CHECK(contains(begins.front()["name"].get<std::string>(), "page "));
}

TEST_CASE("two runs in virtual time write the same bytes") {
  for (const Strategy strategy : {Strategy::svm, Strategy::dataflow}) {
    const RenderOptions options = to_trace(strategy, RunnerKind::virtual_time);
    Traced first(options), second(options);
    CHECK(first.text(".json") == second.text(".json"));
    CHECK(first.text(".paje") == second.text(".paje"));
  }
}

TEST_CASE("a slice says when, how long, of which packet and for which pixel") {
  const std::string text = written({.begin_ns = 1'234'567,
                                    .end_ns = 2'000'000,
                                    .own_ns = 5,
                                    .item = 42,
                                    .depth = 3,
                                    .activity = nodes::Activity::receive,
                                    .packet = 1,
                                    .charged = 1U << static_cast<unsigned>(core::Charge::shading),
                                    .is_cut = true});
  CHECK(contains(text, "\"pid\":2,\"tid\":2,\"ts\":1234.567,\"dur\":765.433,\"name\":\"shade\""));
  CHECK(contains(text, "{\"own_us\":0.005,\"packet\":\"page_reply\",\"x\":2,\"y\":4,\"depth\":3,\"cut\":true}"));
  CHECK(nlohmann::json::parse(text)["otherData"]["scene"] == "a\"b\\c\nd");
}

TEST_CASE("a message that takes no time begins before it ends, and both belong to their slices") {
  nodes::Trace trace{.nodes = std::vector<nodes::TraceNode>(3)};
  const auto hop = [&trace](std::uint32_t from, std::uint32_t to, std::uint32_t sent_call, std::uint32_t received_call) {
    trace.nodes[to].spans.push_back({.begin_ns = 10, .end_ns = 10, .call = received_call});
    trace.messages.push_back({.source = nodes::NodeId{from},
                              .target = nodes::NodeId{to},
                              .sent_call = sent_call,
                              .received_call = received_call,
                              .sent_ns = 10,
                              .received_ns = 10});
  };
  trace.nodes[1].spans.push_back({.begin_ns = 10, .end_ns = 10, .call = 1});
  hop(1, 0, 1, 1);
  hop(0, 2, 1, 1);
  hop(2, 0, 1, 2);
  const char* const kinds[] = {"ray"};
  std::ostringstream output;
  write_chrome({.trace = trace, .kind_names = kinds, .clock = "virtual time", .remarks = {}}, output);
  const nlohmann::json written = nlohmann::json::parse(output.str());
  std::string order;
  for (const nlohmann::json& event : written["traceEvents"]) {
    order += event["ph"] == "M" ? "" : event["ph"].get<std::string>() + std::to_string(event["pid"].get<int>()) + " ";
  }
  CHECK(order == "X2 s2 f1 X1 s1 f3 X3 s3 f1 X1 ");
}

TEST_CASE("a trace of nothing is whole, too") {
  const nodes::Trace nothing{.nodes = std::vector<nodes::TraceNode>(2)};
  std::ostringstream output;
  write_chrome({.trace = nothing, .kind_names = {}, .clock = "wall clock", .remarks = {}}, output);
  const nlohmann::json trace = nlohmann::json::parse(output.str());
  CHECK(trace["traceEvents"].size() == 6);
  CHECK(trace["traceEvents"][0]["args"]["name"] == "node 0");
  CHECK(trace["traceEvents"][3]["args"]["name"] == "host");
}

}  // namespace dmpc::apps::chrome_test
