#include "dataflow/regions/mapping.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <utility>

#include "core/base/expect.h"

namespace dmpc::tests::mapping_test {

namespace {

using dataflow::Bsp;
using dataflow::CutAxes;
using dataflow::Flow;
using dataflow::Mapping;
using nodes::Topology;
using nodes::TopologyKind;

constexpr CutAxes axes{0, 1};
const std::vector<Flow> no_flow;

/// Equal regions of a square.
Bsp square(std::uint32_t count) { return dataflow::equal_size_bsp({64, 64, 64}, axes, count); }

std::vector<Flow> flows_in(const Bsp& bsp) { return dataflow::flows_of(boundaries_of(bsp, axes)); }

bool is_permutation_of_nodes(Mapping mapping) {
  std::sort(mapping.begin(), mapping.end());
  return mapping == dataflow::identity_mapping(static_cast<std::uint32_t>(mapping.size()));
}

/// Exchanges as long as that helps, by the mean over all flows.
Mapping descended(Mapping mapping, const std::vector<Flow>& flows, const Topology& topology) {
  double least = dataflow::mean_hops(mapping, flows, topology);
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    for (std::size_t a = 0; a < mapping.size(); ++a) {
      for (std::size_t b = a + 1; b < mapping.size(); ++b) {
        std::swap(mapping[a], mapping[b]);
        if (const double found = dataflow::mean_hops(mapping, flows, topology); found < least) {
          least = found;
          has_changed = true;
        } else {
          std::swap(mapping[a], mapping[b]);
        }
      }
    }
  }
  return mapping;
}

/// The better of two starting points, as for more than 128 regions.
Mapping mapped_plainly(const Bsp& bsp, const std::vector<Flow>& flows, const Topology& topology) {
  const Mapping first = descended(gray_mapping(bsp), flows, topology);
  const Mapping second = descended(dataflow::identity_mapping(bsp.region_count()), flows, topology);
  return mean_hops(second, flows, topology) < mean_hops(first, flows, topology) ? second : first;
}

}  // namespace

TEST_CASE("the mean of hops is weighted by the flow") {
  const Topology mesh(TopologyKind::mesh, 4);
  const std::vector<Flow> flows{{0, 1, 3}, {0, 3, 1}};
  CHECK(dataflow::mean_hops(dataflow::identity_mapping(4), flows, mesh) == doctest::Approx((3 * 1 + 1 * 2) / 4.0));
  CHECK(dataflow::mean_hops(dataflow::identity_mapping(4), no_flow, mesh) == 0.0);
}

TEST_CASE("the connectivity graph's boundaries are flows by their length") {
  const std::vector<Flow> flows = flows_in(square(2));
  REQUIRE(flows.size() == 1);
  CHECK(flows[0].amount == 64);
}

TEST_CASE("random mappings have the hops of each in their mean") {
  const std::vector<Flow> flows{{0, 1, 3}, {2, 7, 1}};
  const Topology hypercube(TopologyKind::hypercube, 8);
  const auto hops = [&](std::uint64_t seed) { return mean_hops(dataflow::random_mapping(8, seed), flows, hypercube); };
  CHECK(mean_hops_of_random(flows, hypercube, 1) == hops(0));
  CHECK(mean_hops_of_random(flows, hypercube, 3) == doctest::Approx((hops(0) + hops(1) + hops(2)) / 3));
  CHECK(mean_hops_of_random(flows, Topology(TopologyKind::crossbar, 8)) == 1.0);
  CHECK(mean_hops_of_random(no_flow, hypercube) == 0.0);
  CHECK_THROWS_AS(mean_hops_of_random(flows, hypercube, 0), core::InternalError);
}

TEST_CASE("the Gray code puts the neighbours in a regular lattice one hop apart on a hypercube") {
  for (const std::uint32_t count : {2U, 4U, 8U, 16U, 64U, 256U}) {
    const Bsp bsp = square(count);
    const Mapping mapping = gray_mapping(bsp);
    CHECK(is_permutation_of_nodes(mapping));
    CHECK(dataflow::mean_hops(mapping, flows_in(bsp), Topology(TopologyKind::hypercube, count)) == 1.0);
  }
}

TEST_CASE("without 2^n regions the Gray code leaves every region where it is") {
  CHECK(gray_mapping(square(6)) == dataflow::identity_mapping(6));
}

TEST_CASE("a chosen mapping gives every node one region and beats random ones on every topology") {
  for (const TopologyKind kind : {TopologyKind::hypercube, TopologyKind::mesh, TopologyKind::torus, TopologyKind::fat_tree}) {
    for (const std::uint32_t count : {5U, 16U, 24U, 64U}) {
      const Bsp bsp = square(count);
      const std::vector<Flow> flows = flows_in(bsp);
      const Topology topology(kind, count);
      const Mapping mapping = map_regions(bsp, flows, topology);
      CHECK(is_permutation_of_nodes(mapping));
      CHECK(dataflow::mean_hops(mapping, flows, topology) < (count < 16 ? 1.0 : 0.8) * mean_hops_of_random(flows, topology));
    }
  }
}

TEST_CASE("pairs of which it is known that an exchange does not help are not missed") {
  for (const TopologyKind kind : {TopologyKind::hypercube, TopologyKind::mesh, TopologyKind::torus, TopologyKind::fat_tree}) {
    for (const std::uint32_t count : {129U, 144U}) {
      const Bsp bsp = dataflow::equal_size_bsp({64, 40, 64}, axes, count);
      std::vector<Flow> flows = flows_in(bsp);
      for (std::size_t i = 0; i < flows.size(); i += 7) {
        flows[i].amount *= 1 + i % 40;
      }
      flows.push_back({1, count - 2, 33});
      const Topology topology(kind, count);
      CHECK(map_regions(bsp, flows, topology) == mapped_plainly(bsp, flows, topology));
    }
  }
}

TEST_CASE("a regular lattice lies on a hypercube with one hop between neighbours") {
  const Bsp bsp = square(16);
  CHECK(dataflow::mean_hops(map_regions(bsp, flows_in(bsp), Topology(TopologyKind::hypercube, 16)), flows_in(bsp),
                            Topology(TopologyKind::hypercube, 16)) == 1.0);
}

TEST_CASE("on a crossbar all mappings are alike") {
  const Bsp bsp = square(7);
  const Topology crossbar(TopologyKind::crossbar, 7);
  CHECK(dataflow::mean_hops(map_regions(bsp, flows_in(bsp), crossbar), flows_in(bsp), crossbar) == 1.0);
}

TEST_CASE("one region and no flow are mapped") {
  CHECK(map_regions(square(1), no_flow, Topology(TopologyKind::mesh, 1)) == Mapping{0});
  CHECK(is_permutation_of_nodes(map_regions(square(8), no_flow, Topology(TopologyKind::torus, 8))));
}

TEST_CASE("a mapping is the same every time") {
  const Bsp bsp = square(24);
  const Topology torus(TopologyKind::torus, 24);
  CHECK(map_regions(bsp, flows_in(bsp), torus) == map_regions(bsp, flows_in(bsp), torus));
  CHECK(dataflow::random_mapping(24, 5) == dataflow::random_mapping(24, 5));
  CHECK(dataflow::random_mapping(24, 5) != dataflow::random_mapping(24, 6));
}

TEST_CASE("a mapping can be assigned to the regions it was made for") {
  Bsp bsp = square(8);
  const core::Region third = bsp.region_at(3);
  const Mapping mapping = gray_mapping(bsp);
  bsp.assign(mapping);
  CHECK(bsp.region_at(bsp.region_index_of(nodes::NodeId{mapping[3]})) == third);
}

TEST_CASE("regions are put on a machine by the mapping that is chosen for their boundaries") {
  Bsp chosen = square(16), put = square(16);
  chosen.assign(dataflow::map_regions(chosen, flows_in(chosen), Topology(TopologyKind::hypercube, 16)));
  dataflow::map_onto(put, TopologyKind::hypercube, axes);
  for (std::uint32_t node = 0; node < 16; ++node) {
    CHECK(put.region_index_of(nodes::NodeId{node}) == chosen.region_index_of(nodes::NodeId{node}));
  }
}

TEST_CASE("a topology of another size and a flow to nowhere are refused") {
  const std::vector<Flow> to_nowhere{{0, 4, 1}}, to_itself{{2, 2, 1}};
  const Topology mesh(TopologyKind::mesh, 4);
  CHECK_THROWS_AS(map_regions(square(5), {}, mesh), core::InternalError);
  CHECK_THROWS_AS(map_regions(square(4), to_nowhere, mesh), core::InternalError);
  CHECK_THROWS_AS(map_regions(square(4), to_itself, mesh), core::InternalError);
}

}  // namespace dmpc::tests::mapping_test
