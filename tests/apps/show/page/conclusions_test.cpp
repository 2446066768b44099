#include "apps/show/page/conclusions.h"

#include <doctest/doctest.h>

#include <vector>

#include "core/picture/heat_kind.h"
#include "tests/apps/show/watched.h"

namespace dmpc::apps::html {

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

TEST_CASE("a node that did more than the mean is named with how much more") {
  CHECK(evenness(std::vector<double>{1, 1, 4, 2}, "did") == "Node 2 did 2.00 times the mean");
  CHECK(evenness(std::vector<double>{3, 3, 3}, "did") == "All nodes did the same");
  CHECK(evenness(std::vector<double>{3}, "did").empty());
  CHECK(evenness(std::vector<double>{0, 0}, "did").empty());
}

TEST_CASE("a time is concluded with how many nodes were busy, and with its tail") {
  CHECK(time_conclusion(steps_of({100, 100, 100, 100}, {100, 100, 100, 50})) == "On average 94 % of the nodes were busy.");
  CHECK(time_conclusion(steps_of({100, 100, 100, 0}, {100, 100, 100, 50})) ==
        "On average 81 % of the nodes were busy; in the last 25 % of the run it was less than half.");
  CHECK(time_conclusion(steps_of({10, 0}, {0, 10})) ==
        "On average 5.0 % of the nodes were busy, and never half of them at a time.");
  CHECK(time_conclusion(steps_of({}, {})).empty());
}

TEST_CASE("pages are concluded with faults, the hottest pages and the home that served most") {
  CHECK(page_conclusion({.references = 100, .faults = 6}, six_fetches()) ==
        "6 page faults in 100 look-ups (6.0 %); the tenth of the pages that was fetched most had 83 % of the fetches. Node 1 "
        "served "
        "1.33 times the mean.");
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

TEST_CASE("rays between nodes are concluded with the pair that has most of them") {
  CHECK(
      ray_conclusion(std::vector<std::uint64_t>{0, 3, 1, 0}, 8) ==
      "A ray went to another node 0.50 times on average. Most went from node 0 to node 1: 75 % of all, where an even share were "
      "50 %.");
  CHECK(ray_conclusion(std::vector<std::uint64_t>{0}, 8) == "No ray left the node on which it began.");
}

TEST_CASE("a cache is concluded with what twice as many pages would do") {
  const std::vector<svm::PageId> pages = {svm::PageId{0}, svm::PageId{1}, svm::PageId{0}, svm::PageId{1}};
  const MissEstimate misses{.curve = svm::MissCurve(pages)};
  CHECK(cache_conclusion(misses, 1, 100) ==
        "Caches of twice as many pages would miss 0.50 times as often; 50 % of the misses are of pages that a node looks up for "
        "the "
        "first time, which no cache saves.");
  CHECK(cache_conclusion(misses, 2, 100).starts_with("A larger cache would save next to nothing: 100 %"));
  CHECK(cache_conclusion({}, 2, 100).empty());
}

TEST_CASE("every section of every kind of run has a conclusion, of one node, too") {
  for (const Strategy strategy : {Strategy::svm, Strategy::dataflow, Strategy::replicated}) {
    for (const std::uint32_t node_count : {1U, 3U}) {
      for (RenderOptions options : {small(strategy), modelled(strategy)}) {
        options.computer.node_count = node_count;
        const Rendered rendered(options);
        const Account account = account_of(*rendered.report);
        for (const std::string& sentence : {loss_conclusion(account), node_conclusion(account), traffic_conclusion(account),
                                            memory_conclusion(account, rendered.database.page_count())}) {
          CAPTURE(sentence);
          CHECK(sentence.ends_with("."));
          CHECK_FALSE(contains(sentence, "nan"));
          CHECK_FALSE(contains(sentence, "inf"));
        }
      }
    }
  }
}

TEST_CASE("a heat map is concluded with the share of its hottest pixels, where its numbers add up") {
  const HeatField rays{.kind = core::HeatKind::rays, .width = 10, .height = 1, .values = {9, 1, 1, 1, 1, 1, 1, 1, 1, 1}};
  CHECK(heat_conclusion(rays) == "The tenth of the pixels with the most rays had 50 % of all.");
  CHECK(heat_conclusion({.kind = core::HeatKind::depth, .width = 1, .height = 1, .values = {2}}).empty());
  CHECK(heat_conclusion({.kind = core::HeatKind::rays, .width = 1, .height = 1, .values = {0}}).empty());
}

}  // namespace dmpc::apps::html
