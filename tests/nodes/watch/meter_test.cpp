#include "nodes/watch/meter.h"

#include <doctest/doctest.h>

#include <array>
#include <vector>

#include "tests/nodes/watch/toy_kind.h"

namespace dmpc::nodes::meter_test {

namespace {

class Listener final : public Observer {
 public:
  void ended(const Span& /*span*/, const Program& /*program*/) override {}
  void sent(const Passing& /*packet*/) override {}
  void received(const Passing& /*packet*/) override {}
  void worked(const Worked& worked) override { heard.push_back(worked); }

  std::vector<Worked> heard;
};

HeatTotals steps(std::uint64_t count) {
  HeatTotals totals;
  totals[ToyKind::steps] = count;
  return totals;
}

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
    meter.begin(steps(10));
    meter.end(2, 4, steps(13));
    meter.claim(2);
  }
  CHECK(map.sum(ToyKind::steps) == 6);
  CHECK(map.values(ToyKind::node)[2] == 5);
  REQUIRE(listener.heard.size() == 2);
  CHECK(listener.heard[0].node == NodeId{5});
  CHECK(listener.heard[0].item == 2);
  CHECK(listener.heard[0].depth == 4);
}

}  // namespace dmpc::nodes::meter_test
