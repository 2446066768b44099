#include "apps/frontend/show/page/traffic.h"

#include <doctest/doctest.h>

#include <vector>

namespace dmpc::apps::html::page_traffic_test {

namespace {

const std::vector<PacketKindTraffic> three_kinds = {
    {"question", {.packets = 3, .bytes = 300}}, {"never sent", {}}, {"answer", {.packets = 1, .bytes = 700}}};

}  // namespace

TEST_CASE("kinds that were sent have a row, with their share of all bytes") {
  const Table table = packet_table(three_kinds);
  REQUIRE(table.rows().size() == 2);
  CHECK(table.rows()[0] == std::vector<Cell>{"question", std::uint64_t{3}, std::uint64_t{300}, 30.0});
  CHECK(table.rows()[1] == std::vector<Cell>{"answer", std::uint64_t{1}, std::uint64_t{700}, 70.0});
  CHECK(packet_table({}).rows().empty());
}

TEST_CASE("traffic is concluded with what most of its bytes are and, on a machine, with the busiest link") {
  CHECK(traffic_conclusion(three_kinds, nullptr) == "4 packets, 1.00 KB, of which 70 % are of kind \"answer\".");
  CHECK(traffic_conclusion({}, nullptr) == "No packet was sent.");
  nodes::VirtualReport report{.total_ns = 200};
  CHECK(traffic_conclusion(three_kinds, &report) == traffic_conclusion(three_kinds, nullptr));
  report.busiest_links = {{.from = "node 0", .to = "switch 1", .busy_ns = 50}};
  CHECK(traffic_conclusion(three_kinds, &report)
            .ends_with("The busiest link, from node 0 to switch 1, was held for 25 % of the run."));
}

TEST_CASE("messages pass so many links on average, and none no link") {
  CHECK(way_text({.messages = 4, .hops = 10}) == "4 messages from one node to another passed 2.50 links each, on average.");
  CHECK(way_text({}) == "0 messages from one node to another passed 0.00 links each, on average.");
}

}  // namespace dmpc::apps::html::page_traffic_test
