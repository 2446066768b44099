#include "apps/effort/effort.h"

#include <doctest/doctest.h>

#include <sstream>

#include "apps/effort/pilot.h"
#include "apps/effort/render_effort.h"
#include "apps/lab/study/effort.h"
#include "apps/lab/study/options.h"
#include "tests/support/small_subject.h"

namespace dmpc::apps::effort_test {

TEST_CASE("an effort is told in words that promise no more than is known") {
  CHECK(text_of(Effort{.seconds = 0.3}) == "some seconds");
  CHECK(text_of(Effort{.seconds = 7.4}) == "4 to 15 seconds");
  CHECK(text_of(Effort{.seconds = 33.1}) == "15 to 65 seconds");
  CHECK(text_of(Effort{.seconds = 234}) == "2 to 8 minutes");
  CHECK(text_of(Effort{.seconds = 4 * 3600.0}) == "2 to 8 hours");
  CHECK(text_of(Effort{.seconds = 234, .bytes = 1536U << 20U}) == "2 to 8 minutes and up to 1.5 GiB of memory");
  CHECK(text_of(Effort{.seconds = 234, .bytes = 1U << 20U}) == "2 to 8 minutes");
  CHECK(text_of(Effort{.seconds = 7, .bytes = 1536U << 20U, .is_given = true}) ==
        "4 to 15 seconds; nodes are given up to 1.5 GiB of memory, and may touch less");
}

TEST_CASE("nothing is said of an effort where nobody looks") {
  std::ostringstream messages;
  announce("study", {.seconds = 1000}, true, messages);
  CHECK(messages.str().empty());
}

TEST_CASE("a larger picture of the same scene takes longer") {
  const Subject small = tests::small_subject("tetra-3", {16, 16}), large = tests::small_subject("tetra-3", {512, 512});
  const double few = picture_seconds(small.database, small.settings), many = picture_seconds(large.database, large.settings);
  CHECK(few > 0);
  CHECK(many > 20 * few);
}

TEST_CASE("a render of half a minute is long, one of less is not") {
  CHECK(is_long({.seconds = 31}));
  CHECK_FALSE(is_long({.seconds = 29}));
}

TEST_CASE("more pixels, a machine's model and a check take longer") {
  const Subject small = tests::small_subject("tetra-3", {64, 64}), large = tests::small_subject("tetra-3", {512, 512});
  StrategyOptions threads, model;
  model.runner.kind = RunnerKind::virtual_time;
  model.computer.node_count = 64;
  CHECK(render_effort(threads, large).seconds > 4 * render_effort(threads, small).seconds);
  CHECK(render_effort(model, small).seconds > 0.1);  // nodes take time, too
  CHECK(check_effort(large).seconds > 4 * check_effort(small).seconds);
}

TEST_CASE("every run of a study is planned") {
  BalanceStudy balance;
  balance.node_counts = {4, 8};
  CHECK(balance.planned().size() == 8);
  TrafficStudy traffic;
  CHECK(traffic.planned().size() == 21);
  SpeedupStudy speedup;
  speedup.node_counts = {1, 1024};
  const auto runs = speedup.planned();
  REQUIRE(runs.size() == 2);
  CHECK(runs[1].node_count == 1024);
  CHECK(runs[1].is_virtual);
  CHECK(CacheStudy{.cache_pages = {1, 8}}.planned().size() == 7);
}

TEST_CASE("more nodes take longer and more memory") {
  const Subject subject = tests::small_subject("tetra-3", {32, 32});
  const Effort few = effort_of({{Strategy::dataflow, 2, true}}, subject);
  const Effort many = effort_of({{Strategy::dataflow, 64, true}}, subject);
  CHECK(many.seconds > few.seconds);
  CHECK(many.bytes > few.bytes);
  const Effort both = effort_of({{Strategy::dataflow, 2, true}, {Strategy::dataflow, 64, true}}, subject);
  CHECK(both.seconds > 0.5 * many.seconds);
  CHECK(both.bytes >= many.bytes);
}

TEST_CASE("a run that brings a structure of its own is taken to ask for as much memory as svm") {
  const Subject grid = tests::small_subject("tetra-3", {32, 32});
  CHECK(effort_of({{Strategy::forest, 8, true}}, grid).bytes == effort_of({{Strategy::svm, 8, true}}, grid).bytes);
}

}  // namespace dmpc::apps::effort_test
