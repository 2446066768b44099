#include "apps/render/observers.h"

#include <doctest/doctest.h>

#include <numeric>

#include "apps/frontend/run/work.h"
#include "nodes/ranks/rank_links.h"
#include "tests/apps/show/watched.h"
#include "tests/support/loopback_ranks.h"

namespace dmpc::apps::observers_test {

namespace {

template <class Numbers>
std::uint64_t sum_of_numbers(const Numbers& numbers) {
  return std::accumulate(numbers.begin(), numbers.end(), std::uint64_t{0});
}

/// Busy time of all nodes and the host, except for messages.
std::uint64_t busy_ns(const nodes::ActivitySteps& steps) {
  std::uint64_t sum = 0;
  for (const auto& node : steps.nodes) {
    for (const nodes::WorkTimes& times : node) {
      sum += sum_of_numbers(times) - times[static_cast<std::size_t>(Work::messages)];
    }
  }
  return sum;
}

}  // namespace

TEST_CASE("nobody looks on unless somebody wants to know") {
  Observers nobody(observer_order(small(), 10, 20));
  CHECK(nobody.watching().observer == nullptr);
  CHECK(nobody.watching().heat == nullptr);
  CHECK(nobody.watching().elsewhere.order.empty());
  RunProfile nothing = nobody.take();
  CHECK_FALSE(nothing.trace);
  CHECK_FALSE(nothing.view);
}

TEST_CASE("a trace and a page can be asked for at a time") {
  RenderOptions options = small();
  options.trace.path = "trace.pftrace";
  CHECK_FALSE(Observers(observer_order(options, 10, 20)).take().view);
  options.report = "page.html";
  const RunProfile both = Observers(observer_order(options, 10, 20)).take();
  CHECK(both.trace);
  CHECK(both.view);
}

TEST_CASE("a rank keeps its share of a trace's events, and is told what else is to be seen") {
  RenderOptions options = small();
  options.trace.path = "trace.pftrace";
  options.report = "page.html";
  const std::uint64_t events_max = observer_order(options, 10, 20).trace->events_max;
  nodes::Loopback loopback(3);
  nodes::RankLinks links(loopback.rank(0));
  options.computer.ranks = &links;
  const ObserverOrder order = observer_order(options, 10, 20), reported = observer_order_from(bytes_of(order));
  CHECK(order.trace->events_max == events_max / 3);
  CHECK(reported.trace->events_max == order.trace->events_max);
  CHECK(reported.heat_kinds == order.heat_kinds);
  CHECK(reported.pixel_count == 20);
}

TEST_CASE("every fetch is seen, by threads and in virtual time") {
  for (RenderOptions options : {starved(small()), starved(modelled())}) {
    // Else it would follow the clock which node renders what, and how many of its pixels wait for one page.
    options.pages.work_item_side = 0;
    options.pages.in_flight = 1;
    const Watched watched(options);
    const svm::PageCounters pages = std::get<svm::Report>(*watched.report).pages();
    const svm::Fetches& fetches = *watched.view().fetches;
    CHECK(pages.faults > 20);
    CHECK(sum_of_numbers(fetches.by_pair) == pages.faults);
    CHECK(sum_of_numbers(fetches.by_page) == pages.faults);
    CHECK(fetches.sample.size() == pages.faults);
  }
}

TEST_CASE("in virtual time a profile has all computing and all service") {
  for (const Strategy strategy : {Strategy::svm, Strategy::dataflow}) {
    const Watched watched(starved(modelled(strategy)));
    std::uint64_t expected_ns = 0;
    for (const nodes::VirtualTimes& times : account_of(*watched.report).virtual_time->nodes) {
      expected_ns += times.computing_ns + times.service_busy_ns + times.service_idle_ns;
    }
    CHECK(busy_ns(watched.view().steps) == expected_ns);
  }
}

TEST_CASE("where the order of references is fixed, the estimate is what the run missed") {
  RenderOptions options = starved(modelled());
  options.pages.work_item_side = 0;
  const Watched watched(options);
  REQUIRE(watched.view().misses);
  CHECK(watched.view().misses->every == 1);
  CHECK(watched.view().misses->misses(4) == static_cast<double>(std::get<svm::Report>(*watched.report).pages().faults));
}

TEST_CASE("a run with more references than are kept ends, by threads and in virtual time, and its estimate is of a share") {
  for (RenderOptions options : {starved(small()), starved(modelled())}) {
    options.picture.resolution = {40, 30};
    options.computer.node_count = 2;
    const Watched watched(options, 1);
    const MissEstimate& estimate = *watched.view().misses;
    CHECK(std::get<svm::Report>(*watched.report).pages().references > 10'000);
    CHECK(estimate.every > 1);
    CHECK(estimate.every < 1024);
    CHECK(estimate.misses(estimate.every) > 0);
  }
}

TEST_CASE("pages are not looked at where there are none, nor their references where they are counted otherwise") {
  CHECK_FALSE(Watched(small(Strategy::dataflow)).view().fetches);
  CHECK_FALSE(Watched(small(Strategy::replicated)).view().misses);
  RenderOptions options = small();
  options.pages.count_pages = true;
  const Watched counting(options);
  CHECK(counting.view().fetches);
  CHECK_FALSE(counting.view().misses);
}

TEST_CASE("a file of references gets all of them, whatever a page beside it would keep, and without one nobody keeps any") {
  RenderOptions options = starved(modelled());
  CHECK(Watched(options, 1).run_profile.references.empty());
  options.references = "references.csv";
  options.picture.resolution = {80, 60};
  options.computer.node_count = 2;
  const Watched watched(options, 1);
  REQUIRE(watched.run_profile.references.size() == options.computer.node_count);
  CHECK(watched.view().misses->every == 1);
  for (const svm::ReferenceLog& log : watched.run_profile.references) {
    CHECK(log.every() == 1);
    CHECK(log.pages().size() > 1024);
  }
}

TEST_CASE("looking on changes neither the picture nor the run") {
  const Rendered alone(starved(modelled()));
  const Watched watched(starved(modelled()));
  CHECK(account_of(*alone.report).film.hash() == account_of(*watched.report).film.hash());
  CHECK(account_of(*alone.report).virtual_time->hash == account_of(*watched.report).virtual_time->hash);
}

}  // namespace dmpc::apps::observers_test
