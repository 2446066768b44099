#include "apps/run/trace_options.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "nodes/observers/trace.h"
#include "tests/support/text.h"
#include "tests/support/usage.h"

namespace dmpc::apps::trace_options_test {

using tests::contains;
using tests::render_usage_complaint;

namespace {

nodes::TraceChoice choice(std::vector<std::string> more) {
  more.push_back("--trace=a.pftrace");
  return trace_choice(tests::typed_render(more).trace);
}

}  // namespace

TEST_CASE("without its option nothing is recorded, with it everything") {
  CHECK_FALSE(tests::typed_render().trace.path);
  const nodes::TraceChoice all = choice({});
  CHECK(all.from_ns == 0);
  CHECK(all.to_ns == nodes::TraceChoice().to_ns);
  CHECK(all.events_max == 1'000'000);
}

TEST_CASE("a trace's window is given in milliseconds, and either end may be left out") {
  CHECK(choice({"--trace-window=1.5,20"}).from_ns == 1'500'000);
  CHECK(choice({"--trace-window=1.5,20"}).to_ns == 20'000'000);
  CHECK(choice({"--trace-window=0.000001,"}).from_ns == 1);
  CHECK(choice({"--trace-window=3,"}).to_ns == nodes::TraceChoice().to_ns);
  CHECK(choice({"--trace-window=,3"}).from_ns == 0);
  CHECK(choice({"--trace-window=,3"}).to_ns == 3'000'000);
}

TEST_CASE("a trace is Perfetto's, and who asks for another's is told what converts it") {
  CHECK(render_usage_complaint({"--trace=a.b.pftrace"}).empty());
  for (const std::string wrong : {"pftrace", "a.png", "a.pftrace.gz", "a.b.json", "a.b.paje", "a.b.json.gz"}) {
    CHECK_MESSAGE(contains(render_usage_complaint({"--trace=" + wrong}), "expected a file with the ending .pftrace"), wrong);
  }
  for (const std::string wrong : {"a.b.json", "a.b.paje", "a.b.json.gz"}) {
    CHECK_MESSAGE(contains(render_usage_complaint({"--trace=in/" + wrong}), ": traceconv json a.b.pftrace a.b.json"), wrong);
  }
  CHECK(contains(render_usage_complaint({"--trace=a.pftrace.gz"}), "gzip packs it"));
}

}  // namespace dmpc::apps::trace_options_test
