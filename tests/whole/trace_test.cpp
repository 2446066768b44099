// Traces: what was recorded adds up to what the run counted, on every strategy and by either clock, and looking on changes
// nothing.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <vector>

#include "nodes/observers/trace.h"
#include "tests/support/priced_machine.h"
#include "tests/support/small_scenes.h"
#include "tests/support/strategies.h"
#include "tests/support/subject.h"

namespace dmpc::tests::whole_trace_test {
namespace {

using nodes::Activity;
using nodes::Trace;
using nodes::TraceChoice;
using nodes::TraceSpan;

constexpr std::uint32_t traced_nodes = 3;

/// Mirrors, glass, shadows and some sky.
Subject traced() {
  core::BuildOptions options;
  options.page_size_bytes = 512;
  return Subject(core::built_in_scene(core::parse_scene_name("balls-2")), {.width = 8, .height = 8, .knows_background = true},
                 options);
}

/// What a run counted, of every strategy.
struct Counted {
  std::uint64_t quanta = 0, sent = 0, received = 0, hash = 0;
  nodes::VirtualTimes times;
  std::uint64_t pages_served = 0;
};

void add(Counted& sum, const nodes::NodeCounters& counters) {
  sum.quanta += counters.quanta;
  sum.sent += nodes::total(counters.sent).packets;
  sum.received += nodes::total(counters.received).packets;
}

template <class Report>
Counted counted(const Report& report) {
  Counted sum;
  for (const auto& node : report.nodes) {
    add(sum, node.counters);
  }
  add(sum, report.host);
  if (report.virtual_time) {
    sum.hash = report.virtual_time->hash;
    for (const nodes::VirtualTimes& times : report.virtual_time->nodes) {
      sum.times.computing_ns += times.computing_ns;
      sum.times.sending_ns += times.sending_ns;
      sum.times.receiving_ns += times.receiving_ns;
      sum.times.service_busy_ns += times.service_busy_ns;
      sum.times.service_idle_ns += times.service_idle_ns;
    }
  }
  return sum;
}

enum class Way { pages, rays, copies };

/// One run with somebody who looks on, or nobody.
Counted run(const Subject& subject, Way way, const std::optional<nodes::Machine>& machine, nodes::Observer* observer) {
  if (way == Way::rays) {
    const dataflow::Report report =
        run_dataflow(subject, {.computer = {.node_count = traced_nodes, .machine = machine}, .watching = {.observer = observer}});
    CHECK(outcome_of(report) == subject.outcome());
    return counted(report);
  }
  svm::RunOptions options;
  options.computer.node_count = traced_nodes;
  options.computer.machine = machine;
  options.watching.observer = observer;
  if (way == Way::pages) {
    options.pages.cache_pages = 2;
  }
  const svm::Report report = way == Way::pages ? run_svm(subject, options) : run_replicated(subject, options);
  CHECK(outcome_of(report) == subject.outcome());
  Counted result = counted(report);
  result.pages_served = report.pages().served;
  return result;
}

struct Traced {
  Counted counted;
  Trace trace;
};

Traced traced(const Subject& subject, Way way, const std::optional<nodes::Machine>& machine, const TraceChoice& choice = {}) {
  nodes::TraceRecorder recorder(traced_nodes + 1, choice);
  const Counted counted = run(subject, way, machine, &recorder);
  return {counted, recorder.take()};
}

/// How many activities of a kind there were, and how long they took.
struct Sum {
  std::uint64_t count = 0, own_ns = 0, total_ns = 0;
};

Sum sum(const Trace& trace, std::initializer_list<Activity> activities) {
  Sum sum;
  for (const nodes::TraceNode& node : trace.nodes) {
    for (const TraceSpan& span : node.spans) {
      if (std::find(activities.begin(), activities.end(), span.activity) != activities.end()) {
        ++sum.count;
        sum.own_ns += span.own_ns;
        sum.total_ns += span.end_ns - span.begin_ns;
      }
    }
  }
  return sum;
}

/// Whether no span of the node begins before the one ahead of it, or ends after one in which it lies.
bool is_nested(const nodes::TraceNode& node) {
  std::vector<TraceSpan> open;
  for (const TraceSpan& span : node.spans) {
    if (!open.empty() && open.back().begin_ns > span.begin_ns) {
      return false;
    }
    while (!open.empty() && open.back().end_ns <= span.begin_ns) {
      open.pop_back();
    }
    if (span.end_ns < span.begin_ns || (!open.empty() && open.back().end_ns < span.end_ns)) {
      return false;
    }
    if (span.begin_ns != span.end_ns) {
      open.push_back(span);
    }
  }
  return true;
}

std::uint64_t end_of(const Trace& trace) {
  std::uint64_t end_ns = 0;
  for (const nodes::TraceNode& node : trace.nodes) {
    for (const TraceSpan& span : node.spans) {
      end_ns = std::max(end_ns, span.end_ns);
    }
  }
  return end_ns;
}

/// Whether a node does something from a time to another.
bool has_between(const Trace& trace, std::uint64_t from_ns, std::uint64_t to_ns) {
  return std::any_of(trace.nodes.begin(), trace.nodes.end(), [&](const nodes::TraceNode& node) {
    return std::any_of(node.spans.begin(), node.spans.end(),
                       [&](const TraceSpan& span) { return span.begin_ns < to_ns && from_ns <= span.end_ns; });
  });
}

constexpr Way all_ways[] = {Way::pages, Way::rays, Way::copies};

}  // namespace

TEST_CASE("a trace has every quantum and every packet of a run, in order of time, by either clock") {
  const Subject small = traced();
  for (const Way way : all_ways) {
    for (const auto& machine : {std::optional<nodes::Machine>(), std::optional(priced_machine())}) {
      const auto [counted, trace] = traced(small, way, machine);
      CHECK(trace.nodes.size() == traced_nodes + 1);
      CHECK(sum(trace, {Activity::work}).count == counted.quanta);
      CHECK(sum(trace, {Activity::receive, Activity::serve}).count == counted.received);
      CHECK(trace.messages.size() == counted.sent);
      CHECK(trace.events_lost == 0);
      CHECK(std::all_of(trace.nodes.begin(), trace.nodes.end(), is_nested));
      for (const nodes::TraceMessage& message : trace.messages) {
        CHECK(message.sent_ns <= message.received_ns);
      }
    }
  }
}

TEST_CASE("in virtual time what the nodes did takes as long as the run says") {
  const Subject small = traced();
  for (const Way way : all_ways) {
    const auto [counted, trace] = traced(small, way, priced_machine());
    const nodes::VirtualTimes& times = counted.times;
    CHECK(sum(trace, {Activity::work, Activity::receive}).own_ns == times.computing_ns);
    CHECK(sum(trace, {Activity::send}).own_ns == times.sending_ns);
    CHECK(sum(trace, {Activity::serve}).total_ns == times.service_busy_ns + times.service_idle_ns);
    CHECK(sum(trace, {Activity::serve}).count == counted.pages_served);
    CHECK(sum(trace, {Activity::work, Activity::receive, Activity::send, Activity::take_over}).total_ns ==
          times.computing_ns + times.sending_ns + times.receiving_ns + times.service_busy_ns);
  }
}

TEST_CASE("looking on does not change a run in virtual time") {
  const Subject small = traced();
  for (const Way way : all_ways) {
    CHECK(run(small, way, priced_machine(), nullptr).hash == traced(small, way, priced_machine()).counted.hash);
  }
}

TEST_CASE("a trace with room for a part of a run has its first and its last percent, by either clock") {
  const Subject small = traced();
  for (const Way way : all_ways) {
    for (const auto& machine : {std::optional<nodes::Machine>(), std::optional(priced_machine())}) {
      const auto [counted, trace] = traced(small, way, machine, {.events_max = 200});
      REQUIRE(trace.times);
      CHECK(trace.events_lost > 0);
      for (const nodes::TraceNode& node : trace.nodes) {
        for (const TraceSpan& span : node.spans) {
          CHECK(trace.times->has(span.begin_ns));
        }
      }
      const std::uint64_t end_ns = end_of(trace);
      CHECK((!machine || end_ns == end_of(traced(small, way, machine).trace)));
      CHECK(trace.times->has(0));
      CHECK((!machine || has_between(trace, 0, end_ns / 100)));  // threads may take longer to start
      CHECK(has_between(trace, end_ns - end_ns / 100, end_ns));
    }
  }
}

}  // namespace dmpc::tests::whole_trace_test
