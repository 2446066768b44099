#include "apps/frontend/system/stopwatch.h"

#include <doctest/doctest.h>
#include <unistd.h>

namespace dmpc::tests::stopwatch_test {

namespace {

/// Works until the processor has been at it for so long.
void work_for(double seconds) {
  apps::ProcessorStopwatch stopwatch(CLOCK_THREAD_CPUTIME_ID);
  for (double done = 0; done < seconds; done += stopwatch.lap()) {
  }
}

}  // namespace

TEST_CASE("waiting takes time but no processor time") {
  apps::DoubleStopwatch stopwatch;
  ::usleep(20'000);
  const apps::Times times = stopwatch.lap();
  CHECK(times.wall_seconds >= 0.02);
  CHECK(times.processor_seconds < 0.01);
}

TEST_CASE("work takes both, and a lap begins where the last one ended") {
  apps::DoubleStopwatch stopwatch;
  work_for(0.01);
  const apps::Times times = stopwatch.lap();
  CHECK(times.processor_seconds >= 0.01);
  CHECK(times.wall_seconds >= 0.0099);
  CHECK(stopwatch.lap().processor_seconds < 0.01);
}

}  // namespace dmpc::tests::stopwatch_test
