#include "apps/edge/run/option_words.h"

#include <doctest/doctest.h>

#include <string>

#include "svm/plan.h"

namespace dmpc::tests::option_words_test {

TEST_CASE("what a plan says of its fields is said of the options that set them") {
  CHECK(apps::in_options("node_count=5000: from 1 to 4096 nodes") == "--nodes=5000: from 1 to 4096 nodes");
  CHECK(apps::in_options("node_memory_bytes=1KiB is too small for node_count=8") ==
        "--node-memory=1KiB is too small for --nodes=8");
  CHECK(apps::in_options("nothing of that") == "nothing of that");
  CHECK(apps::in_options("--nodes=3, or host_node_count=3") == "--nodes=3, or host_node_count=3");
}

TEST_CASE("a plan that is refused is refused in the words of the command line, as what it was") {
  const auto refused = [](const svm::PlanRequest& request) {
    return apps::with_options_named([&] { return svm::make_plan(request); });
  };
  const svm::PlanRequest none{.page_count = 4, .computer = {.node_count = 0}, .width = 1, .height = 1};
  CHECK_THROWS_WITH_AS(refused(none), doctest::Contains("--nodes=0: from 1 to"), core::UsageError);
  const svm::PlanRequest small{.page_count = 4, .computer = {.node_memory_bytes = 1}, .width = 1, .height = 1};
  CHECK_THROWS_WITH_AS(refused(small), doctest::Contains("--node-memory=1B is too small for --nodes=8"), core::RoomError);
}

}  // namespace dmpc::tests::option_words_test
