#include "apps/lab/bench/speed/comparison.h"

#include <doctest/doctest.h>

#include <sstream>
#include <vector>

#include "core/base/expect.h"

namespace dmpc::tests::comparison_test {

using apps::Comparison;
using apps::Figures;
using apps::ratio_of;
using Each = std::vector<double>;

TEST_CASE("a ratio is the middle one of the rounds and not that of middle figures") {
  const Figures figures{{1, 8, 9}, {2, 2, 18}};
  CHECK(ratio_of(figures).median == 0.5);
  CHECK(ratio_of(figures).least == 0.5);
  CHECK(ratio_of(figures).most == 4);
}

TEST_CASE("a round that only one of two has ended does not count") {
  const Figures figures{{6, 100}, {3}};
  CHECK(figures.rounds() == 1);
  CHECK(ratio_of(figures).median == 2);
  CHECK(ratio_of(figures).most == 2);
}

TEST_CASE("nothing is compared before a round has ended or with a baseline that took nothing") {
  CHECK(Figures{}.rounds() == 0);
  CHECK_THROWS_AS(ratio_of(Figures{{1}, {}}), core::InternalError);
  CHECK_THROWS_AS(ratio_of(Figures{{1}, {0}}), core::InternalError);
}

TEST_CASE("what is timed is compared by the wall clock and by processor time") {
  std::vector<Comparison> results(1);
  apps::Matches matches(results);
  const auto slow = matches.add([] { return apps::figures_of({.wall_seconds = 6, .processor_seconds = 8}); });
  const auto fast = matches.add([] { return apps::figures_of({.wall_seconds = 3, .processor_seconds = 2}); });
  matches.compare_timed(slow, fast, {.scene = "tetra-2"});
  REQUIRE(results.size() == 2);
  std::ostringstream silent;
  apps::Progress progress(silent, false, "");
  matches.measure(1, progress);
  CHECK(ratio_of(results[1].figures).median == 2);
  CHECK(ratio_of(results[1].processor).median == 4);
  CHECK(results[0].figures.rounds() == 0);
}

TEST_CASE("contenders take turns round by round, and each has one figure of a round in all its comparisons, its own included") {
  std::vector<Comparison> results;
  apps::Matches matches(results);
  double clock = 0;
  const auto first = matches.add([&] { return std::vector{++clock}; }),
             second = matches.add([&] { return std::vector{++clock}; });
  matches.compare(first, first, {});
  matches.compare(second, first, {});
  std::ostringstream silent;
  apps::Progress progress(silent, false, "");
  matches.measure(2, progress);
  CHECK(results[0].figures.subject == Each{1, 3});
  CHECK(results[0].figures.baseline == Each{1, 3});
  CHECK(results[1].figures.subject == Each{2, 4});
  CHECK(results[1].figures.baseline == Each{1, 3});
}

TEST_CASE("a round in which a figure could not be told is none of the comparisons that ask for it, and the others keep theirs") {
  std::vector<Comparison> results;
  apps::Matches matches(results);
  double round = 0;
  const auto baseline = matches.add([&] { return std::vector{++round, 10.0}; });
  const auto subject = matches.add([&] { return std::vector{round == 2 ? apps::no_figure : 2 * round, 5 * round}; });
  matches.compare(subject, baseline, {});
  matches.compare(subject, baseline, {}, 1);
  std::ostringstream silent;
  apps::Progress progress(silent, false, "");
  matches.measure(3, progress);
  CHECK(results[0].figures.subject == Each{2, 6});
  CHECK(results[0].figures.baseline == Each{1, 3});
  CHECK(results[1].figures.subject == Each{5, 10, 15});
}

}  // namespace dmpc::tests::comparison_test
