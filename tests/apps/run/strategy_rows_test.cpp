#include "apps/run/strategy_rows.h"

#include <doctest/doctest.h>

#include <string>

#include "svm/forest/strategy.h"
#include "svm/plan.h"

namespace dmpc::tests::strategy_rows_test {

TEST_CASE("a plan that is refused is refused in the words of the command line, as what it was") {
  const auto refused = [](const svm::PlanRequest& request) {
    return apps::with_options_named(apps::strategy_words(), [&] { return svm::make_plan(request); });
  };
  const svm::PlanRequest none{.page_count = 4, .computer = {.node_count = 0}, .width = 1, .height = 1};
  CHECK_THROWS_WITH_AS(refused(none), doctest::Contains("--nodes=0: from 1 to"), core::UsageError);
  const svm::PlanRequest small{.page_count = 4, .computer = {.node_memory_bytes = 1}, .width = 1, .height = 1};
  CHECK_THROWS_WITH_AS(refused(small), doctest::Contains("--node-memory=1B is too small for --nodes=8"), core::CapacityError);
  const svm::PlanRequest held{
      .strategy = svm::replicated_strategy(), .page_count = 4, .pages = {.cache_pages = 5}, .width = 1, .height = 1};
  CHECK_THROWS_WITH_AS(refused(held), "--cache-pages goes with --strategy=svm", core::UsageError);
}

TEST_CASE("what goes with svm alone is said alike by the plan and by the rows of options") {
  for (const apps::PageRow& row : apps::page_rows()) {
    CAPTURE(row.name);
    CHECK(apps::has(apps::Strategy::svm, row));
    CHECK_FALSE(apps::has(apps::Strategy::dataflow, row));
    CHECK(apps::has(apps::Strategy::forest, row) == svm::goes_with(row.takes.field, *svm::forest_strategy()));
  }
}

}  // namespace dmpc::tests::strategy_rows_test
