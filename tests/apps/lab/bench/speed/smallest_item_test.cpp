#include "apps/lab/bench/speed/smallest_item.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace dmpc::apps::smallest_item_test {
namespace {

/// A round in which an item of so much work cost so much.
Comparison item(const std::string& subject, double work_us, double cost_us) {
  return {.part = SpeedPart::emulation,
          .what = item_comparison,
          .subject = subject,
          .subject_figures = {cost_us},
          .rival_figures = {work_us}};
}

}  // namespace

TEST_CASE("the smallest work lies between two measured ones, by the logarithm") {
  // From 1.6 at 4 us to 1.0 at 16 us: 1.3 is half way, which is 8 us.
  const std::vector<std::string> sentences =
      smallest_items(std::vector{item("a pool", 1, 5), item("a pool", 4, 6.4), item("a pool", 16, 16)});
  REQUIRE(sentences.size() == 1);
  CHECK(sentences[0] ==
        "Smallest work an item at which a pool cost 1.3 times the work alone, processor time: 8.0 us (5.0 times with 1.0 us, "
        "1.00 with 16 us).");
}

TEST_CASE("the last work that costs more decides, whatever a smaller one cost") {
  const std::vector<std::string> sentences =
      smallest_items(std::vector{item("a", 1, 1.2), item("a", 4, 6.4), item("a", 16, 16), item("a", 64, 64)});
  CHECK(sentences.at(0).find(": 8.0 us (") != std::string::npos);
}

TEST_CASE("where all or none of the works cost more, that is what is said") {
  const std::vector<std::string> sentences =
      smallest_items(std::vector{item("cheap", 1, 1.1), item("dear", 1, 9), item("cheap", 2, 2), item("dear", 20, 40)});
  REQUIRE(sentences.size() == 2);
  CHECK(sentences[0].find(": less than 1.0 us (") != std::string::npos);
  CHECK(sentences[1].find(": more than 20 us (") != std::string::npos);
}

TEST_CASE("what is no item, or has no round, has no smallest work") {
  Comparison unmeasured = item("a", 1, 1);
  unmeasured.rival_figures.clear();
  CHECK(smallest_items(std::vector{unmeasured, Comparison{.part = SpeedPart::emulation, .what = "nodes"}}).empty());
}

}  // namespace dmpc::apps::smallest_item_test
