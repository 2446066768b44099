#include "apps/run/trace_options.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "apps/main/commands.h"
#include "apps/run/render_options.h"
#include "core/base/expect.h"
#include "nodes/watch/trace.h"
#include "tests/support/text.h"
#include "tests/support/usage.h"

namespace dmpc::apps::trace_options_test {

using tests::contains;
using tests::render_usage_complaint;

namespace {

RenderOptions traced_render(const std::vector<std::string>& more) {
  std::vector<std::string> arguments = {"render", "teapot-12", "--nodes=6", "-o", "a.png"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return parse_command_line(arguments).options<RenderOptions>();
}

nodes::TraceChoice choice(std::vector<std::string> more) {
  more.push_back("--trace=a.json");
  return trace_choice(traced_render(more).trace, 6);
}

}  // namespace

TEST_CASE("without its option nothing is recorded, with it everything") {
  CHECK_FALSE(traced_render({}).trace.path);
  const nodes::TraceChoice all = choice({});
  CHECK(all.from_ns == 0);
  CHECK(all.to_ns == nodes::TraceChoice().to_ns);
  CHECK(all.nodes.empty());
  CHECK(all.every == 1);
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

TEST_CASE("a trace's nodes are numbers, rows of them and the host") {
  CHECK(choice({"--trace-nodes=0,2-3"}).nodes == std::vector<bool>{true, false, true, true, false, false, false});
  CHECK(choice({"--trace-nodes=host"}).nodes == std::vector<bool>{false, false, false, false, false, false, true});
  CHECK(choice({"--trace-nodes=5-5,host"}).nodes == std::vector<bool>{false, false, false, false, false, true, true});
  for (const std::string wrong : {"", "0,", "3-2", "-1", "1-", "6", "0-6", "a", "1.5", "hosts"}) {
    CHECK_MESSAGE(contains(render_usage_complaint({"--trace=a.json", "--trace-nodes=" + wrong}), "--trace-nodes"), wrong);
  }
}

TEST_CASE("one pixel in so many and the most events are whole numbers above 0") {
  CHECK(choice({"--trace-every=100"}).every == 100);
  CHECK(choice({"--trace-events=5"}).events_max == 5);
  CHECK(choice({}).keep == nodes::TraceKeep::spread);
  CHECK(choice({"--trace-keep=first"}).keep == nodes::TraceKeep::first);
  CHECK_FALSE(render_usage_complaint({"--trace=a.json", "--trace-every=0"}).empty());
  CHECK_FALSE(render_usage_complaint({"--trace=a.json", "--trace-events=0"}).empty());
}

TEST_CASE("a trace has one of three formats, packed or not, and what chooses from it needs one") {
  CHECK(render_usage_complaint({"--trace=a.json"}).empty());
  CHECK(render_usage_complaint({"--trace=a.paje"}).empty());
  CHECK(render_usage_complaint({"--trace=a.pftrace"}).empty());
  CHECK(render_usage_complaint({"--trace=a.b.pftrace.gz"}).empty());
  for (const std::string option :
       {"--trace-window=0,1", "--trace-nodes=0", "--trace-every=2", "--trace-events=9", "--trace-keep=last"}) {
    CHECK_MESSAGE(contains(render_usage_complaint({option}), "give --trace=FILE"), option);
  }
}

}  // namespace dmpc::apps::trace_options_test
