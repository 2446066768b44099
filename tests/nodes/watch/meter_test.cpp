#include "nodes/watch/meter.h"

#include <doctest/doctest.h>

#include <array>
#include <vector>

namespace dmpc::nodes {

namespace {

class Listener final : public Observer {
 public:
  void ended(const Span& /*span*/, const Program& /*program*/) override {}
  void sent(const Passing& /*packet*/) override {}
  void received(const Passing& /*packet*/) override {}
  void worked(const Worked& worked) override { heard.push_back(worked); }

  std::vector<Worked> heard;
};

}  // namespace

TEST_CASE("a meter that nobody wants is not wanted") {
  HeatMap map(1, {});
  Listener listener;
  CHECK_FALSE(Watching().is_metered());
  CHECK(Watching{.heat = &map}.is_metered());
  CHECK(Watching{.observer = &listener}.is_metered());
}

TEST_CASE("a meter tells the heat map and the observer, whichever there is") {
  constexpr std::array kinds = {HeatKind::rays, HeatKind::node};
  HeatMap map(3, kinds);
  Listener listener;
  for (const Watching& watching :
       {Watching{.heat = &map, .observer = &listener}, Watching{.heat = &map}, Watching{.observer = &listener}}) {
    Meter meter(watching, nullptr, NodeId{5});
    meter.begin({.rays = 10});
    meter.end(2, 4, {.rays = 13});
    meter.claim(2);
  }
  CHECK(map.sum(HeatKind::rays) == 6);
  CHECK(map.values(HeatKind::node)[2] == 5);
  REQUIRE(listener.heard.size() == 2);
  CHECK(listener.heard[0].node == NodeId{5});
  CHECK(listener.heard[0].pixel == 2);
  CHECK(listener.heard[0].depth == 4);
}

}  // namespace dmpc::nodes
