#include "apps/frontend/show/page/view_conclusions.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace dmpc::apps::html::view_conclusions_test {

namespace {

/// Three pages, six fetches of 10 us each, 8 of them on the way.
svm::Fetches six_fetches() {
  svm::Fetches fetches{.peer_count = 2, .by_pair = {0, 4, 2, 0}, .by_page = {1, 5, 0}};
  fetches.sample.assign(6, {.part_ns = {0, 0, 0, 2000, 8000, 0}});
  return fetches;
}

/// Two nodes and the host, in steps of 100 ns.
nodes::ActivitySteps steps_of(const std::vector<std::uint64_t>& first, const std::vector<std::uint64_t>& second) {
  nodes::ActivitySteps steps{.step_ns = 100, .nodes = std::vector<std::vector<nodes::WorkTimes>>(3)};
  for (std::size_t step = 0; step < first.size(); ++step) {
    steps.nodes[0].push_back({first[step], 0, 0, 0, 0, 0});
    steps.nodes[1].push_back({second[step], 0, 0, 0, 0, 0});
    steps.nodes[2].push_back({100, 0, 0, 0, 0, 0});
  }
  return steps;
}

}  // namespace

TEST_CASE("a time is concluded with how many nodes were busy, and with its tail") {
  CHECK(time_conclusion(steps_of({100, 100, 100, 100}, {100, 100, 100, 50})) == "On average 94 % of the nodes were busy.");
  CHECK(time_conclusion(steps_of({100, 100, 100, 0}, {100, 100, 100, 50})) ==
        "On average 81 % of the nodes were busy; in the last 25 % of the run it was less than half.");
  CHECK(time_conclusion(steps_of({10, 0}, {0, 10})) ==
        "On average 5.0 % of the nodes were busy, and never half of them at a time.");
  CHECK(time_conclusion(steps_of({}, {})).empty());
}

TEST_CASE("a time is concluded with the name of what was waited for most, of nodes without the host") {
  nodes::ActivitySteps steps = steps_of({50, 50}, {50, 50});
  steps.waits = {{{10, 0}, {10, 0}}, {{0, 0}, {0, 5}}, {{0, 100}, {0, 100}}};
  const std::vector<std::string> names = {"page wait", "starvation", "", "", "", "", ""};
  CHECK(time_conclusion(steps, names) == "On average 50 % of the nodes were busy. Most of what they waited was \"page wait\".");
  CHECK(time_conclusion(steps) == "On average 50 % of the nodes were busy.");
}

TEST_CASE("shares are of the time that passed: the last step ends with the run") {
  nodes::ActivitySteps steps = steps_of({100, 20}, {100, 0});
  steps.end_ns = 120;
  steps.waits = {{{}, {}}, {{}, {20}}, {{}, {}}};
  const std::vector<std::string> names = {"page wait", "", "", "", "", "", ""};
  CHECK(time_conclusion(steps, names) == "On average 75 % of the nodes were busy. Most of what they waited was \"page wait\".");
}

TEST_CASE("pages are concluded with faults, the hottest pages and the home that served most") {
  CHECK(page_conclusion({.references = 100, .misses = 9, .faults = 6}, six_fetches()) ==
        "9 of 100 look-ups missed (9.00 %), with 6 page faults: one page is fetched for all that wait for it. The tenth of the "
        "pages that was fetched most had 83 % of the fetches. Node 1 served 1.33 times the mean.");
  svm::Fetches at_host{.peer_count = 2, .by_pair = {0, 6, 0, 0}, .by_page = {1, 5, 0}};
  at_host.where = svm::PageHomes::host;
  CHECK(page_conclusion({.references = 100, .faults = 6}, at_host).find("The host, home to all pages, served all.") !=
        std::string::npos);
  CHECK(page_conclusion({.references = 100}, {.peer_count = 1}) ==
        "No page was fetched: each node found all that it looked up at home.");
}

TEST_CASE("a fetch is concluded with its length and its largest part") {
  CHECK(fetch_conclusion(six_fetches()) ==
        "A fetch takes 10.0 us on average; the largest part of it, 80 %, is \"page on its way\".");
  CHECK(fetch_conclusion({}).empty());
  svm::Fetches instant = six_fetches();
  instant.sample.assign(2, {});
  CHECK(fetch_conclusion(instant) == "A fetch takes no time on this machine.");
}

TEST_CASE("a cache is concluded with what twice as many pages would do") {
  const std::vector<svm::PageId> pages = {svm::PageId{0}, svm::PageId{1}, svm::PageId{0}, svm::PageId{1}};
  const MissEstimate misses{.curve = svm::MissCurve(pages)};
  CHECK(cache_conclusion(misses, 1) ==
        "Twice the cache would fault 0.50 times as often. 50 % of the faults are of pages that a node looks up for the first "
        "time, which no cache avoids.");
  CHECK(cache_conclusion(misses, 2).starts_with("A larger cache would save almost nothing. 100 %"));
  CHECK(cache_conclusion({}, 2).empty());
}

}  // namespace dmpc::apps::html::view_conclusions_test
