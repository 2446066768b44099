// When each pixel was done: what a page lights at a time is what was done by then, on every strategy and by either clock.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/picture/heat_kind.h"
#include "nodes/observers/done_observer.h"
#include "nodes/observers/observer_group.h"
#include "nodes/observers/trace.h"
#include "tests/support/priced_machine.h"
#include "tests/support/small_scenes.h"
#include "tests/support/strategies.h"
#include "tests/support/subject.h"

namespace dmpc::tests::whole_done_test {
namespace {

using core::HeatKind;

constexpr int side = 8;
constexpr std::uint32_t node_count = 3;

/// Mirrors, glass, shadows and some sky.
Subject subject() {
  core::BuildOptions options;
  options.page_size_bytes = 512;
  return Subject(core::built_in_scene(core::parse_scene_name("balls-2")),
                 {.width = side, .height = side, .knows_background = true}, options);
}

/// A run, and what a trace of it tells of its pixels.
struct Run {
  explicit Run(nodes::TraceChoice choice = {}) : recorder(node_count + 1, choice) {}

  nodes::HeatMap map{side * side, std::array{HeatKind::done}};
  nodes::DoneObserver observer{node_count + 1, map};
  nodes::TraceRecorder recorder;
  nodes::ObserverGroup both{{&observer, &recorder}};

  std::span<const std::uint64_t> done() const { return map.values(HeatKind::done); }

  /// The end of the last span that names the pixel: of each call a trace keeps one pixel.
  std::vector<std::uint64_t> last_seen() {
    std::vector<std::uint64_t> ends(side * side);
    for (const nodes::TraceNode& node : recorder.take().nodes) {
      for (const nodes::TraceSpan& span : node.spans) {
        if (span.item != nodes::TraceSpan::no_item) {
          ends[span.item] = std::max(ends[span.item], span.end_ns);
        }
      }
    }
    return ends;
  }
};

struct Computer {
  std::optional<nodes::Machine> machine = {};
  std::optional<std::uint32_t> pool_threads = {};
};

std::vector<Computer> computers() { return {{}, {.pool_threads = 2}, {.machine = priced_machine()}}; }

svm::RunOptions one_in_flight(const Computer& computer) {
  svm::RunOptions options;
  options.computer.node_count = node_count;
  options.computer.machine = computer.machine;
  options.computer.pool_threads = computer.pool_threads;
  options.pages.cache_pages = 2;
  options.pages.in_flight = 1;
  return options;
}

}  // namespace

TEST_CASE("the pixels that are lit at a time are those on which nobody works from then on") {
  const Subject small = subject();
  for (const Computer& computer : computers()) {
    Run run;
    svm::RunOptions options = one_in_flight(computer);
    options.watching.observer = &run.both;
    CHECK(outcome_of(run_svm(small, options)) == small.outcome());
    const std::vector<std::uint64_t> last = run.last_seen();
    CHECK(std::ranges::count(run.done(), 0U) == 0);
    CHECK(std::ranges::equal(run.done(), last));
    std::vector<std::uint64_t> times(run.done().begin(), run.done().end());
    std::sort(times.begin(), times.end());
    CHECK(times.front() < times.back());
  }
}

TEST_CASE("with several pixels in flight, and with rays that travel, no call works on a pixel after it is done") {
  const Subject small = subject();
  for (const Computer& computer : computers()) {
    Run pages, rays;
    svm::RunOptions options = one_in_flight(computer);
    options.pages.in_flight = 16;
    options.watching.observer = &pages.both;
    CHECK(outcome_of(run_svm(small, options)) == small.outcome());
    dataflow::RunOptions traveling;
    traveling.computer = options.computer;
    traveling.watching.observer = &rays.both;
    CHECK(outcome_of(run_dataflow(small, traveling)) == small.outcome());
    for (Run* const run : {&pages, &rays}) {
      const std::vector<std::uint64_t> last = run->last_seen();
      for (std::size_t pixel = 0; pixel < last.size(); ++pixel) {
        CHECK(run->done()[pixel] >= last[pixel]);
      }
    }
  }
}

}  // namespace dmpc::tests::whole_done_test
