#include "apps/render/live_steps.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace dmpc::apps::live_steps_test {

namespace {

/// Node 0 has traced for `traced_ns` of the time until `ns`, node 1 has shaded all the time, and the host's time is nobody's.
LiveMoment moment(std::uint64_t ns, std::uint64_t traced_ns) {
  std::vector<nodes::LiveNode> nodes(3);
  nodes[0].now_ns = ns;
  nodes[0].busy_ns[0] = traced_ns;
  nodes[1].busy_ns[1] = ns;
  nodes[2].busy_ns[5] = ns;
  return {ns / 10, nodes};
}

std::size_t level(char cell) { return static_cast<unsigned char>(cell) / nodes::work_count; }
std::size_t work(char cell) { return static_cast<unsigned char>(cell) % nodes::work_count; }

}  // namespace

TEST_CASE("a step says how busy each node was, and with what most") {
  LiveSteps steps(4);
  CHECK(steps.add(moment(0, 0)) == 0);
  CHECK(steps.count() == 0);
  CHECK(steps.add(moment(100, 50)) == 0);
  REQUIRE(steps.count() == 1);
  const std::string cells = steps.cells(0);
  REQUIRE(cells.size() == 2);
  CHECK(level(cells[0]) == LiveSteps::levels_max / 2);
  CHECK(work(cells[0]) == 0);
  CHECK(level(cells[1]) == LiveSteps::levels_max);
  CHECK(work(cells[1]) == 1);
}

TEST_CASE("where there would be too many, steps become twice as long and say the same of all that time") {
  LiveSteps steps(4);
  for (std::uint64_t i = 0; i < 5; ++i) {
    steps.add(moment(1000 + 100 * i, i > 3 ? 200 : 50 * i));
  }
  CHECK(steps.count() == 4);
  CHECK(steps.doublings() == 0);
  CHECK(steps.add(moment(1500, 200)) == 0);  // all have become others
  CHECK(steps.doublings() == 1);
  REQUIRE(steps.count() == 2);
  CHECK(steps.end_ms(1) == 40);
  CHECK(level(steps.cells(0)[0]) == LiveSteps::levels_max / 2);
  CHECK(level(steps.cells(1)[0]) == LiveSteps::levels_max / 2);
  CHECK(steps.add(moment(1600, 200)) == 2);  // from 1,400 to 1,600
  CHECK(steps.add(moment(1700, 300)) == steps.count());
  CHECK(steps.count() == 3);
  CHECK(level(steps.cells(2)[0]) == 0);
}

TEST_CASE("where no time has passed nobody was busy, and nobody is busier than all the time") {
  LiveSteps steps(4);
  steps.add(moment(100, 50));
  steps.add(moment(100, 80));
  steps.add(moment(101, 100));
  CHECK(level(steps.cells(0)[0]) == 0);
  CHECK(level(steps.cells(1)[0]) == LiveSteps::levels_max);
}

TEST_CASE("shares are of the time of all nodes") {
  const std::vector<double> shares = shares_between(moment(0, 0), moment(100, 50));
  CHECK(shares == std::vector<double>{0.25, 0.5, 0, 0, 0, 0, 0, 0});
}

}  // namespace dmpc::apps::live_steps_test
