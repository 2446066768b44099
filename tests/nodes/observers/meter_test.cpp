#include "nodes/observers/meter.h"

#include <doctest/doctest.h>

#include <array>
#include <ctime>
#include <vector>

#include "nodes/threads/clock.h"
#include "tests/nodes/observers/toy_kind.h"

namespace dmpc::nodes::meter_test {

namespace {

class Listener final : public Observer {
 public:
  void worked(const Worked& worked) override { heard.push_back(worked); }

  std::vector<Worked> heard;
};

constexpr std::array all_kinds = {ToyKind::bites, ToyKind::crumbs, ToyKind::drops, ToyKind::steps,
                                  ToyKind::time,  ToyKind::node,   ToyKind::depth};

/// Every operation takes a nanosecond.
Machine priced() {
  Machine machine;
  machine.cost_ps.fill(1000);
  return machine;
}

/// So many of each, and operations.
HeatTotals totals(std::uint64_t count, std::uint64_t operations) {
  HeatTotals totals;
  totals[ToyKind::steps] = count;
  totals[ToyKind::crumbs] = 10 * count;
  totals[ToyKind::bites] = 100 * count;
  totals[ToyKind::drops] = 1000 * count;
  totals.charges.count[6] = operations;
  return totals;
}

std::vector<std::uint64_t> values(const HeatMap& map, ToyKind kind) { return {map.values(kind).begin(), map.values(kind).end()}; }

using Values = std::vector<std::uint64_t>;

}  // namespace

TEST_CASE("a meter that nobody wants is not wanted") {
  HeatMap map(1, std::array<ToyKind, 0>{});
  Listener listener;
  CHECK_FALSE(Watching().is_metered());
  CHECK(Watching{.heat = &map}.is_metered());
  CHECK(Watching{.observer = &listener}.is_metered());
}

TEST_CASE("a meter tells the heat map and the observer, whichever there is") {
  constexpr std::array kinds = {ToyKind::steps, ToyKind::node};
  HeatMap map(3, kinds);
  Listener listener;
  for (const Watching& watching :
       {Watching{.heat = &map, .observer = &listener}, Watching{.heat = &map}, Watching{.observer = &listener}}) {
    Meter meter(watching, nullptr, NodeId{5});
    meter.begin(totals(10, 0));
    meter.end(2, 4, totals(13, 0));
    meter.claim(2);
  }
  CHECK(map.sum(ToyKind::steps) == 6);
  CHECK(map.values(ToyKind::node)[2] == 5);
  REQUIRE(listener.heard.size() == 2);
  CHECK(listener.heard[0].node == NodeId{5});
  CHECK(listener.heard[0].item == 2);
  CHECK(listener.heard[0].depth == 4);
}

TEST_CASE("what is counted between begin and end is the item's") {
  const Machine machine = priced();
  HeatMap map(3, all_kinds);
  Meter meter({.heat = &map}, &machine, NodeId{4});
  meter.begin(totals(5, 50));
  meter.end(2, 3, totals(7, 51));
  meter.claim(2);
  CHECK(values(map, ToyKind::steps) == Values{0, 0, 2});
  CHECK(values(map, ToyKind::crumbs) == Values{0, 0, 20});
  CHECK(values(map, ToyKind::bites) == Values{0, 0, 200});
  CHECK(values(map, ToyKind::drops) == Values{0, 0, 2000});
  CHECK(values(map, ToyKind::time) == Values{0, 0, 1000});
  CHECK(values(map, ToyKind::depth) == Values{0, 0, 3});
  CHECK(values(map, ToyKind::node) == Values{0, 0, 4});
}

TEST_CASE("an end begins the next item's share, and a begin leaves out what came before") {
  const Machine machine = priced();
  HeatMap map(2, all_kinds);
  Meter meter({.heat = &map}, &machine, NodeId{0});
  meter.begin(totals(0, 0));
  meter.end(0, 1, totals(1, 1));
  meter.end(1, 5, totals(3, 3));
  meter.begin(totals(10, 10));
  meter.end(1, 2, totals(11, 12));
  CHECK(values(map, ToyKind::steps) == Values{1, 3});
  CHECK(values(map, ToyKind::time) == Values{1000, 4000});
  CHECK(values(map, ToyKind::depth) == Values{1, 5});
}

TEST_CASE("without a machine the time is the processor's") {
  HeatMap map(1, all_kinds);
  Meter meter({.heat = &map}, nullptr, NodeId{0});
  const std::uint64_t before_ns = nanoseconds(CLOCK_THREAD_CPUTIME_ID);
  meter.begin({});
  while (nanoseconds(CLOCK_THREAD_CPUTIME_ID) < before_ns + 1'000'000) {
  }
  meter.end(0, 1, totals(1, 1'000'000'000));
  const std::uint64_t time_ps = map.values(ToyKind::time)[0];
  CHECK(time_ps > 0);
  CHECK(time_ps <= (nanoseconds(CLOCK_THREAD_CPUTIME_ID) - before_ns) * 1000);
}

}  // namespace dmpc::nodes::meter_test
