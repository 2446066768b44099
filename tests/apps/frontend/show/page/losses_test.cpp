#include "apps/frontend/show/page/losses.h"

#include <doctest/doctest.h>

#include <vector>

#include "apps/frontend/table/table.h"

namespace dmpc::apps::html::page_losses_test {

namespace {

const Losses two_nodes = {
    .parts = {"computing", "page wait", "service while busy"}, .nodes = {{60, 0, 40}, {20, 0, 80}}, .is_virtual = true};

}  // namespace

TEST_CASE("parts that no node has are left out, but computing never is") {
  CHECK(without_empty_parts(two_nodes).parts == std::vector<std::string>{"computing", "service while busy"});
  CHECK(without_empty_parts(two_nodes).nodes[1] == std::vector<std::uint64_t>{20, 80});
  CHECK(without_empty_parts({.parts = {"computing", "service while idle"}, .nodes = {{0, 0}}}).parts ==
        std::vector<std::string>{"computing"});
}

TEST_CASE("each node has a row in percent, and all together one") {
  const Table table = loss_table(two_nodes);
  REQUIRE(table.rows().size() == 3);
  CHECK(table.rows()[0] == std::vector<Cell>{"0", 60.0, 0.0, 40.0});
  CHECK(table.rows()[2] == std::vector<Cell>{"all", 40.0, 0.0, 60.0});
  CHECK(table.notes().front().find("Service while busy and service while idle") != std::string::npos);
  CHECK(loss_table({.parts = {"computing"}, .nodes = {{1}}, .is_virtual = true}).notes().front() == "Virtual time.");
}

TEST_CASE("losses are concluded with the largest of them and the node that computed most") {
  CHECK(loss_conclusion(two_nodes) ==
        "The nodes computed for 40 % of their time; most of the rest was \"service while busy\", 60 %. Node 0 computed for 1.50 "
        "times the "
        "mean.");
  CHECK(loss_conclusion({.parts = {"computing"}, .nodes = {{5}}, .is_virtual = true}) ==
        "The nodes computed for 100 % of their time.");
  CHECK(loss_conclusion({.parts = {"computing"}, .nodes = {{0}}, .is_virtual = true}) == "No virtual time passed.");
}

TEST_CASE("threads compute, sleep and wait for a core, and clocks that disagree make no part negative") {
  const std::vector<nodes::NodeCounters> counters = {{.busy_ns = 50, .asleep_ns = 25, .wall_ns = 100},
                                                     {.busy_ns = 60, .asleep_ns = 50, .wall_ns = 100}};
  const Losses losses = wall_losses(counters);
  CHECK(losses.nodes[0] == std::vector<std::uint64_t>{50, 25, 25});
  CHECK(losses.nodes[1].back() == 0);
  CHECK(loss_conclusion(wall_losses(std::vector<nodes::NodeCounters>{{.busy_ns = 50, .asleep_ns = 25, .wall_ns = 100}})) ==
        "The nodes computed for 50 % of their time, slept without packets for 25 % and waited for a core of this computer, or "
        "for their turn in a pool, for 25 %.");
  CHECK(loss_conclusion(wall_losses(std::vector<nodes::NodeCounters>(1))) == "No time passed.");
}

}  // namespace dmpc::apps::html::page_losses_test
