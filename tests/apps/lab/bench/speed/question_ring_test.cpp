#include "apps/lab/bench/speed/question_ring.h"

#include <doctest/doctest.h>

#include "core/base/expect.h"

namespace dmpc::apps::question_ring_test {

TEST_CASE("every item is asked for, answered and worked on, on threads and in a pool") {
  for (const RunnerKind runner : {RunnerKind::threads, RunnerKind::pool}) {
    for (const std::uint32_t items : {0U, 1U, 3U, 40U}) {
      const QuestionRing ring{.node_count = 5, .items_in_flight = 3, .items_a_node = items, .steps = 10};
      CHECK(times_of(ring, runner).processor_seconds >= 0);  // throws if one was lost
      CHECK(ring.item_count() == 5 * items);
    }
  }
}

TEST_CASE("a node alone has nobody to ask") {
  CHECK_THROWS_AS(times_of({.node_count = 1}, RunnerKind::pool), core::InternalError);
}

TEST_CASE("an item's work is as long a chain as it has steps") {
  CHECK(work_on_item(5, 0) == 5);
  CHECK(work_on_item(work_on_item(5, 3), 4) == work_on_item(5, 7));
  CHECK(work_on_item(5, 3) != work_on_item(5, 4));
}

}  // namespace dmpc::apps::question_ring_test
