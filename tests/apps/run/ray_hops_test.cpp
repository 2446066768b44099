#include "apps/run/ray_hops.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <vector>

namespace dmpc::apps::ray_hops_test {

namespace {

using nodes::TopologyKind;

/// The report of a run with these numbers of rays from each node (row) to each other (column).
dataflow::Report report_with(const std::vector<std::vector<std::uint64_t>>& rays) {
  dataflow::Report report{{{.film = core::Film(1, 1)}}, 0, {}, dataflow::Bsp({1, 1, 1})};
  for (const std::vector<std::uint64_t>& row : rays) {
    report.nodes.emplace_back();
    for (std::uint32_t owner = 0; owner < row.size(); ++owner) {
      if (row[owner] > 0) {
        report.nodes.back().program.pairs.push_back({{.rays = {row[owner]}}, owner});
      }
    }
  }
  return report;
}

}  // namespace

TEST_CASE("the hops of rays are weighted by their number") {
  // On a hypercube 0 and 3 are two links apart, 1 and 3 one.
  const dataflow::Report report = report_with({{0, 0, 0, 3}, {0, 0, 0, 1}, {0, 0, 0, 0}, {0, 4, 0, 0}});
  CHECK(ray_hops_of(report, TopologyKind::hypercube).mean == (3 * 2 + 1 + 4) / 8.0);
  CHECK(ray_hops_of(report, TopologyKind::crossbar).mean == 1);
}

TEST_CASE("random mappings put rays as far as nodes are apart on average") {
  const dataflow::Report report = report_with({{0, 5, 5, 5}, {5, 0, 5, 5}, {5, 5, 0, 5}, {5, 5, 5, 0}});
  CHECK(ray_hops_of(report, TopologyKind::hypercube).mean_of_random == doctest::Approx(4.0 / 3));
  CHECK(ray_hops_of(report, TopologyKind::hypercube).mean == doctest::Approx(4.0 / 3));
}

TEST_CASE("rays that stay have no hops") {
  CHECK(ray_hops_of(report_with({{0}}), TopologyKind::mesh).mean == 0);
  CHECK(ray_hops_of(report_with({{0, 0}, {0, 0}}), TopologyKind::torus).mean_of_random == 0);
}

}  // namespace dmpc::apps::ray_hops_test
