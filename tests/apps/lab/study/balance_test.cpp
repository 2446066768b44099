#include "apps/lab/study/studies.h"

#include <doctest/doctest.h>

#include <string>

#include "dataflow/regions/mapping.h"
#include "tests/support/study_subject.h"

namespace dmpc::tests::study_balance_test {

namespace {

using apps::BalanceStudy;
using apps::Table;

bool mentions_article(const std::string& scene) {
  for (const std::string& note : BalanceStudy().notes(scene)) {
    if (note.find("82.5 %") != std::string::npos) {
      return true;
    }
  }
  return false;
}

}  // namespace

TEST_CASE("balance has a row for each node count and way to cut") {
  const BalanceStudy study{.node_counts = {2, 5}};
  StudySubject subject("rings-2-t1");
  const Table table = subject.measure(study);
  REQUIRE(table.rows().size() == 8);
  CHECK(subject.runs.count() == 8);
  CHECK(whole(table, 1, "nodes") == 2);
  CHECK(whole(table, 4, "nodes") == 5);
  CHECK(std::get<std::string>(cell(table, 4, "regions")) == "subsampled");
  CHECK(std::get<std::string>(cell(table, 5, "regions")) == "subsampled, alternating");
  CHECK(std::get<std::string>(cell(table, 6, "regions")) == "equal size");
  CHECK(std::get<std::string>(cell(table, 7, "regions")) == "scattered, 16 a node");
  for (const std::size_t row : {6U, 7U}) {
    CHECK(is_missing(table, row, "average load predicted"));
  }
}

TEST_CASE("cuts in alternating directions make other regions than those across the longer side, which rays cross elsewhere") {
  StudySubject subject("tetra-3");
  const Table table = subject.measure(BalanceStudy{.node_counts = {8}});
  const auto by = [&](dataflow::CutOrder order) {
    const dataflow::BalanceOptions cutting{.bsp = {.order = order}};
    return subject.runs.run("again", dataflow::RunOptions{.computer = {.node_count = 8}, .rays = {.balance = cutting}});
  };
  CHECK(real(table, 0, "moves a ray") == by(dataflow::CutOrder::longer_axis).messages_per_ray());
  CHECK(real(table, 1, "moves a ray") == by(dataflow::CutOrder::alternating).messages_per_ray());
  CHECK(real(table, 0, "moves a ray") != real(table, 1, "moves a ray"));
}

TEST_CASE("scattered regions are 16 a node, and their load is more even than that of one region of equal size") {
  StudySubject subject("rings-2-t1", 64);
  const Table table = subject.measure(BalanceStudy{.node_counts = {8}});
  const dataflow::Report scattered = subject.runs.run(
      "again", dataflow::RunOptions{.computer = {.node_count = 8},
                                    .rays = {.balance = {.balance = dataflow::Balance::scattered, .regions_a_node = 16}}});
  CHECK(real(table, 3, "moves a ray") == scattered.messages_per_ray());
  CHECK(real(table, 3, "average load achieved") > real(table, 2, "average load achieved"));
}

TEST_CASE("regions by the subsampled picture are more even than those of equal size") {
  const Table table = StudySubject("rings-2-t1", 64).measure(BalanceStudy{.node_counts = {8}, .subsample = 2});
  for (const std::size_t row : {0U, 1U}) {
    CHECK(real(table, row, "average load achieved") > 1.5 * real(table, 2, "average load achieved"));
    CHECK(real(table, row, "average load predicted") > real(table, 2, "average load achieved"));
  }
  CHECK(real(table, 0, "average load predicted") <= 100);
  CHECK(real(table, 0, "duplication") >= 1);
}

TEST_CASE("the figures are those of the run") {
  StudySubject subject("balls-2");
  const Table table = subject.measure(BalanceStudy{.node_counts = {5}, .topology = nodes::TopologyKind::mesh});
  const dataflow::Report report = subject.runs.run(
      "again", dataflow::RunOptions{.computer = {.node_count = 5}, .rays = {.topology = nodes::TopologyKind::mesh}});
  const nodes::Topology mesh(nodes::TopologyKind::mesh, 5);
  const std::vector<dataflow::Flow> flows = report.ray_flows();
  CHECK(real(table, 0, "average load predicted") == 100 * dataflow::average_load(report.predicted));
  CHECK(real(table, 0, "average load achieved") == 100 * dataflow::average_load(report.work()));
  CHECK(real(table, 0, "duplication") == report.duplication);
  CHECK(real(table, 0, "hops") == dataflow::mean_hops(dataflow::identity_mapping(5), flows, mesh));
  CHECK(real(table, 0, "hops at random") == dataflow::mean_hops_of_random(flows, mesh));
}

TEST_CASE("one node is all the load, and no ray hops") {
  const Table table = StudySubject("balls-1").measure(BalanceStudy{.node_counts = {1}});
  CHECK(real(table, 0, "average load achieved") == 100);
  CHECK(is_missing(table, 0, "hops"));
  CHECK(is_missing(table, 0, "hops at random"));
}

TEST_CASE("rows by node are asked for, follow their run, and share out the whole") {
  const Table table = StudySubject("rings-2-t1").measure(BalanceStudy{.node_counts = {3}, .per_node = true});
  REQUIRE(table.rows().size() == 16);
  double predicted = 0, achieved = 0;
  for (std::size_t row = 1; row <= 3; ++row) {
    CHECK(whole(table, row, "node") == row - 1);
    CHECK(is_missing(table, row, "hops"));
    predicted += real(table, row, "share predicted");
    achieved += real(table, row, "share achieved");
  }
  CHECK(predicted == doctest::Approx(100));
  CHECK(achieved == doctest::Approx(100));
  CHECK(is_missing(table, 0, "node"));
  CHECK(is_missing(table, 9, "share predicted"));
  CHECK(BalanceStudy().columns().size() + 3 == table.columns().size());
}

TEST_CASE("no node count, no row") { CHECK(StudySubject("balls-1").measure(BalanceStudy{.node_counts = {}}).rows().empty()); }

TEST_CASE("the article's figures stand below its scene alone") {
  CHECK(mentions_article("rings-3-t1"));
  CHECK_FALSE(mentions_article("rings-3"));
  CHECK_FALSE(mentions_article("rings-4-t1"));
  CHECK_FALSE(mentions_article("./rings-3-t1.nff"));
}

}  // namespace dmpc::tests::study_balance_test
