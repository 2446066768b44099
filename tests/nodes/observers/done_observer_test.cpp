#include "nodes/observers/done_observer.h"

#include <doctest/doctest.h>

#include <array>
#include <cstdint>
#include <vector>

#include "tests/nodes/observers/silent_program.h"
#include "tests/nodes/observers/toy_kind.h"

namespace dmpc::nodes::done_observer_test {

namespace {

/// Two nodes and a host that tell a watch over four items what the test says.
struct WatchedNodes {
  void works_on(std::uint32_t node, std::uint32_t item) { observer.worked({.node = NodeId{node}, .item = item}); }
  void ends(std::uint32_t node, std::uint64_t end_ns, Activity activity = Activity::work) {
    observer.ended({.node = NodeId{node}, .activity = activity, .end_ns = end_ns}, program);
  }
  std::vector<std::uint64_t> done() const { return {map.values(ToyKind::done).begin(), map.values(ToyKind::done).end()}; }

  HeatMap map{4, std::array{ToyKind::done}};
  DoneObserver observer{3, map};
  SilentProgram program;
};

using Times = std::vector<std::uint64_t>;

}  // namespace

TEST_CASE("all that a call has worked on is done when it ends, and what nobody worked on is never done") {
  WatchedNodes reported;
  reported.works_on(0, 1);
  reported.works_on(0, 3);
  CHECK(reported.done() == Times{0, 0, 0, 0});
  reported.ends(0, 70);
  CHECK(reported.done() == Times{0, 70, 0, 70});
  reported.ends(0, 90);  // a call that works on nothing
  CHECK(reported.done() == Times{0, 70, 0, 70});
}

TEST_CASE("an interrupt that ends within a call is not the end of the call") {
  WatchedNodes reported;
  reported.works_on(1, 0);
  reported.ends(1, 10, Activity::serve);
  reported.ends(1, 20, Activity::take_over);
  reported.ends(1, 30, Activity::send);
  CHECK(reported.done() == Times{0, 0, 0, 0});
  reported.ends(1, 40, Activity::receive);
  CHECK(reported.done() == Times{40, 0, 0, 0});
}

TEST_CASE("of several nodes that work on an item the last one's end stays, in whatever order they are told") {
  WatchedNodes reported;
  reported.works_on(0, 2);
  reported.works_on(1, 2);
  reported.ends(1, 500);
  reported.ends(0, 400);
  CHECK(reported.done() == Times{0, 0, 500, 0});
  reported.works_on(2, 2);
  reported.ends(2, 600);
  CHECK(reported.done() == Times{0, 0, 600, 0});
}

TEST_CASE("of ranks the later time stays, by the clock of the rank that adds; what was not worked on there is not there") {
  HeatMap here(3, std::array{ToyKind::done}), there(3, std::array{ToyKind::done});
  here.raise(ToyKind::done, 0, 1000);
  here.raise(ToyKind::done, 1, 1000);
  there.raise(ToyKind::done, 1, 1100);
  // The other clock gains 200 ns while 1,000 pass here, so its 1,100 is 1,000 less nearly 200.
  const ClockDrift clock({.asked_ns = 0, .reported_ns = 0, .heard_ns = 0},
                         {.asked_ns = 1000, .reported_ns = 1200, .heard_ns = 1000}, 0);
  here.add(there.bytes(), clock);
  CHECK(here.values(ToyKind::done)[0] == 1000);
  CHECK(here.values(ToyKind::done)[1] == 1000);
  CHECK(clock.corrected(1100) < 1000);
  CHECK(here.values(ToyKind::done)[2] == 0);
  there.raise(ToyKind::done, 2, 600);
  here.add(there.bytes(), clock);
  CHECK(here.values(ToyKind::done)[2] == 500);
}

}  // namespace dmpc::nodes::done_observer_test
