#include "apps/frontend/show/page/node_bands.h"

#include <doctest/doctest.h>

#include <sstream>
#include <string>

#include "apps/frontend/show/page/node_table.h"
#include "tests/support/text.h"

namespace dmpc::apps::html::node_bands_test {

using tests::contains;

namespace {

/// Node n did 100 - n things, and twice as many others; a sum of all follows.
Table things_of(std::size_t nodes) {
  Table table("Things", {{"node"}, {"things"}, {"others", "KiB", 1}});
  for (std::size_t node = 0; node < nodes; ++node) {
    table.add_row({std::to_string(node), std::uint64_t{100 - node}, 2.0 * static_cast<double>(100 - node)});
  }
  table.add_row({"all", std::uint64_t{9999}, 9999.0});
  return table;
}

Plot plot() {
  return bars_by_node("things", "Things", {.label = "", .least = 0}, {{"some things", "things"}, {"others", "others"}});
}

std::string page_with(std::size_t nodes) {
  Page page("Nodes");
  add_node_plot(page, plot(), things_of(nodes));
  return page.text();
}

}  // namespace

TEST_CASE("bands are ranks of what the nodes have, without their sum") {
  const Table bands = band_table(plot(), things_of(100));
  REQUIRE(bands.rows().size() == 2);
  CHECK(bands.rows()[0] == std::vector<Cell>{"some things", std::uint64_t{1}, std::uint64_t{5}, std::uint64_t{50},
                                             std::uint64_t{95}, std::uint64_t{100}});
  CHECK(bands.rows()[1] == std::vector<Cell>{"others", 2.0, 10.0, 100.0, 190.0, 200.0});
  CHECK(bands.columns().size() == 6);
}

TEST_CASE("of one node all bands are what it has") {
  CHECK(band_table(plot(), things_of(1)).rows()[0] == std::vector<Cell>{"some things", std::uint64_t{100}, std::uint64_t{100},
                                                                        std::uint64_t{100}, std::uint64_t{100},
                                                                        std::uint64_t{100}});
}

TEST_CASE("up to 64 nodes have a bar each, more are a band that takes as much room however many they are") {
  CHECK_FALSE(contains(page_with(64), "Over all nodes"));
  CHECK(contains(page_with(65), "Over all nodes"));
  CHECK(page_with(65).size() < page_with(64).size());
  const std::size_t few = page_with(65).size(), many = page_with(100).size();
  CHECK(std::max(few, many) - std::min(few, many) < 500);
}

}  // namespace dmpc::apps::html::node_bands_test
