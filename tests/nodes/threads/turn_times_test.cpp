#include "nodes/threads/turn_times.h"

#include <doctest/doctest.h>

#include "nodes/counters.h"

namespace dmpc::tests::turn_times_test {
namespace {

using namespace nodes;

TEST_CASE("short turns take what the wall clock says, the last one the rest of the thread's processor time") {
  NodeCounters a, b;
  TurnTimes times;
  times.begin(1000, 50);
  CHECK_FALSE(times.end_turn(a, 1300));
  CHECK_FALSE(times.end_turn(b, 1400));
  CHECK(times.end_turn(a, 1400 + TurnTimes::long_turn_ns));  // in which the thread waited for its core
  CHECK(times.now_ns() == 1400 + TurnTimes::long_turn_ns);
  times.share_out(50 + 900);
  CHECK(a.busy_ns == 800);
  CHECK(b.busy_ns == 100);
}

TEST_CASE("no more processor time is shared out than there was") {
  NodeCounters a, b;
  TurnTimes times;
  times.begin(0, 0);
  CHECK_FALSE(times.end_turn(a, 300));
  CHECK_FALSE(times.end_turn(b, 400));
  CHECK_FALSE(times.end_turn(a, 500));
  times.share_out(200);
  CHECK(a.busy_ns == 150);
  CHECK(b.busy_ns == 50);
}

TEST_CASE("a sleep is nobody's turn") {
  NodeCounters a;
  TurnTimes times;
  times.begin(0, 0);
  CHECK_FALSE(times.end_turn(a, 100));
  times.share_out(100);
  times.share_out(105);
  times.begin(900, 110);
  CHECK_FALSE(times.end_turn(a, 1000));
  times.share_out(210);
  CHECK(a.busy_ns == 200);
}

TEST_CASE("so many short turns are shared out together, turns of no length, too") {
  NodeCounters a;
  TurnTimes times;
  times.begin(5, 0);
  for (std::size_t turn = 1; turn < TurnTimes::turns_max; ++turn) {
    CHECK_FALSE(times.end_turn(a, 5));
  }
  CHECK(times.end_turn(a, 5));
  times.share_out(40);
  CHECK(a.busy_ns == 40);
}

}  // namespace
}  // namespace dmpc::tests::turn_times_test
