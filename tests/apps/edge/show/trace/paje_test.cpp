#include "apps/edge/show/trace/paje.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <sstream>
#include <string>

#include "tests/apps/show/trace/traced.h"
#include "tests/support/child_process.h"

namespace dmpc::apps::paje_test {

namespace {

using tests::ChildProcess;
using tests::TemporaryFolder;

/// What pajeng's reader makes of a text, a line for each state, link and value; its status stands in front.
std::string dump(const std::string& text) {
  const TemporaryFolder folder;
  tests::write_text(folder / "a.paje", text);
  ChildProcess reader({"/usr/bin/pj_dump", "--float-precision=9", (folder / "a.paje").string()});
  const int status = reader.status();
  return std::to_string(status) + "\n" + reader.output();
}

/// Lines that begin so.
std::uint64_t count(const std::string& text, const std::string& beginning) {
  std::uint64_t found = 0;
  for (std::size_t at = text.find("\n" + beginning); at != std::string::npos; at = text.find("\n" + beginning, at + 1)) {
    ++found;
  }
  return found;
}

/// The time of all nodes, from lines "State, node, activity, begin, end, duration, depth, name" in seconds with nine decimals.
std::uint64_t shading_ns(const std::string& read) {
  std::istringstream lines(read);
  std::uint64_t sum_ns = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("State, ", 0) == 0 && line.rfind(", shade") == line.size() - 7) {
      std::istringstream fields(line);
      std::string field;
      for (int i = 0; i < 6; ++i) {
        std::getline(fields, field, ',');
      }
      field.erase(field.find('.'), 1);
      sum_ns += std::stoull(field);
    }
  }
  return sum_ns;
}

std::uint64_t states_with_duration(const nodes::Trace& trace) {
  std::uint64_t sum = 0;
  for (const nodes::TraceNode& node : trace.nodes) {
    sum += static_cast<std::uint64_t>(std::count_if(node.spans.begin(), node.spans.end(),
                                                    [](const nodes::TraceSpan& span) { return span.begin_ns != span.end_ns; }));
  }
  return sum;
}

}  // namespace

TEST_CASE("pajeng reads a Paje trace, and finds in it all nodes, states and messages") {
  for (const Strategy strategy : {Strategy::svm, Strategy::dataflow, Strategy::replicated}) {
    for (const RunnerKind runner : {RunnerKind::threads, RunnerKind::virtual_time}) {
      Traced traced(to_trace(strategy, runner));
      const std::string read = dump(traced.text(".paje"));
      CHECK(read.substr(0, 2) == "0\n");
      CHECK(count(read, "Container, computer, node") == 4);
      CHECK(count(read, "Link, computer, message") == nodes::total(account_of(traced.report).sent).packets);
      CHECK(count(read, "State, ") == states_with_duration(traced.trace));
      CHECK(count(read, "Variable, ") > 10);
    }
  }
}

TEST_CASE("pajeng finds each activity in virtual time as long as it was") {
  Traced traced(to_trace(Strategy::svm, RunnerKind::virtual_time));
  std::uint64_t sum_ns = 0;
  for (const nodes::TraceNode& node : traced.trace.nodes) {
    for (const nodes::TraceSpan& span : node.spans) {
      sum_ns += name_of(span) == SpanName::shade ? span.end_ns - span.begin_ns : 0;
    }
  }
  CHECK(sum_ns > 0);
  CHECK(shading_ns(dump(traced.text(".paje"))) == sum_ns);
}

TEST_CASE("pajeng refuses a Paje trace that lacks a line") {
  std::string text = Traced(to_trace(Strategy::svm, RunnerKind::virtual_time)).text(".paje");
  text.erase(text.find("\n1 S N "), text.find("\n3 L ") - text.find("\n1 S N "));
  CHECK(dump(text).substr(0, 2) != "0\n");
}

}  // namespace dmpc::apps::paje_test
