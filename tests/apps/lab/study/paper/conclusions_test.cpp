#include "apps/lab/study/paper/report.h"

#include <doctest/doctest.h>

#include <cstdint>

namespace dmpc::apps::paper_conclusions_test {

namespace {

const std::string nothing;

}  // namespace

TEST_CASE("a table of the article without rows, or an unknown one, has no conclusion") {
  for (const char* const name :
       {"claims", "table_2", "table_3", "algorithms", "caches", "region_loads", "ray_ways", "work_items", "losses",
        "voxel_prices", "voxel_pairs", "law", "grid_table_3", "calibration", "sensitivity", "no table"}) {
    CHECK(paper_conclusion(name, Table("", {{"scene"}, {"nodes"}})) == nothing);
  }
}

TEST_CASE("predictions are concluded with their mean and worst differences, without what was calibrated") {
  Table table("", {{"scene"}, {"nodes"}, {"difference", "points", 1}, {"use"}});
  table.add_row({"Teapot", std::uint64_t{2}, -1.0, "predicted"});
  table.add_row({"Teapot", std::uint64_t{64}, 4.0, "predicted"});
  table.add_row({"Mountain", std::uint64_t{2}, 9.0, "calibrated"});
  CHECK(
      paper_conclusion("table_3", table) ==
      "The efficiencies that were predicted lie 2.5 points from the printed ones in the mean, at worst 4.0 points (Teapot, nodes "
      "64).");
}

TEST_CASE("the largest loss is that of the most nodes, in the mean over scenes") {
  Table table("", {{"scene"}, {"nodes"}, {"computing", "%"}, {"data_wait", "%"}, {"idle_at_end", "%"}});
  table.add_row({"a", std::uint64_t{1}, 10.0, 90.0, 0.0});
  table.add_row({"a", std::uint64_t{64}, 70.0, 10.0, 20.0});
  table.add_row({"b", std::uint64_t{64}, 50.0, 20.0, 30.0});
  CHECK(paper_conclusion("losses", table) ==
        "On 64 nodes the largest loss is idle at end: 25.0 % of the nodes' time in the mean over scenes.");
}

TEST_CASE("claims are counted by their verdicts") {
  Table table("", {{"claim"}, {"verdict"}, {"found"}});
  table.add_row({"a", "held", ""});
  table.add_row({"b", "not held", ""});
  CHECK(paper_conclusion("claims", table) == "1 of 2 claims held.");
  table.add_row({"c", "not judged", ""});
  CHECK(paper_conclusion("claims", table) == "1 of 3 claims held, 1 were not judged.");
}

TEST_CASE("other tables of the article are concluded from their columns") {
  Table pages("", {{"scene"}, {"pages a pixel printed"}, {"pages a pixel"}});
  pages.add_row({"a", 10.0, 5.0});
  pages.add_row({"b", 10.0, 12.0});
  CHECK(paper_conclusion("table_2", pages) == "A pixel takes 0.50 to 1.20 times the pages that the article prints.");
  Table travel("", {{"scene"}, {"nodes"}, {"rays travel", "s"}, {"pages travel", "s"}});
  travel.add_row({"a", std::uint64_t{64}, 4.0, 1.0});
  CHECK(paper_conclusion("algorithms", travel) == "On 64 nodes pages that travel take 0.25 times as long as rays (a).");
  Table ways("", {{"scene"}, {"way"}, {"efficiency", "%"}});
  ways.add_row({"a", "slow", 20.0});
  ways.add_row({"a", "fast", 40.0});
  CHECK(paper_conclusion("ray_ways", ways) == "Rays travel best, with an efficiency of 40.0 %, on a by fast.");
  Table items("", {{"item"}, {"asked of"}, {"seconds", "s", 0}});
  items.add_row({"static", "nobody", 700.0});
  items.add_row({"3x3", "ring", 604.0});
  CHECK(paper_conclusion("work_items", items) ==
        "The picture takes from 604 s with 3x3 asked of ring to 700 s with static asked of nobody.");
  Table caches("", {{"scene"}, {"of the database", "%"}, {"efficiency", "%"}});
  caches.add_row({"a", 0.5, 3.0});
  caches.add_row({"a", 10.0, 90.0});
  CHECK(paper_conclusion("caches", caches) ==
        "The efficiency goes from 3.0 % with caches of 0.50 % of the database to 90.0 % with 10.00 %.");
  Table errors("", {{"cells"}, {"our mean error"}, {"the law's mean error"}});
  errors.add_row({"all", 2.0, 3.0});
  CHECK(paper_conclusion("law", errors) == "Over all we are nearer: 2.0 points off in the mean, against 3.0 points.");
}

}  // namespace dmpc::apps::paper_conclusions_test
