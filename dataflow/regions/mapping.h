// The mapping of regions to nodes: neighbours in space should be neighbours in the machine, since most rays go to an adjacent
// region.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "dataflow/regions/bsp.h"
#include "nodes/topology.h"

namespace dmpc::dataflow {

/// The traffic between two regions: the length of their boundary, or counted rays. Regions by number, first != second.
struct Flow {
  std::uint32_t first = 0, second = 0;
  std::uint64_t amount = 0;
};

/// The node of each region, by region number: a permutation.
using Mapping = std::vector<std::uint32_t>;

/// The boundary lengths of the connectivity graph as flows.
std::vector<Flow> flows_of(std::span<const Boundary> boundaries);

/// Hops per unit of flow, the amounts as weights; 0 without any flow.
double mean_hops(const Mapping& mapping, std::span<const Flow> flows, const nodes::Topology& topology);

/// The mean of mean_hops() over random_mapping() with seeds 0 to mapping_count - 1; at least one.
double mean_hops_of_random(std::span<const Flow> flows, const nodes::Topology& topology, std::uint32_t mapping_count = 32);

/// A mapping with few hops for the given flows: the best of several starting points (gray_mapping(), region i on node i and, up
/// to 128 regions, a few random ones), each improved by exchanging two regions' nodes as long as an exchange helps.
/// Deterministic; a local optimum. Looks once at each pair of regions per starting point, and after that at those that have
/// changed; stops once every flow takes one hop. Requires as many nodes as regions.
Mapping map_regions(const Bsp& bsp, std::span<const Flow> flows, const nodes::Topology& topology);

/// Assigns the regions to the nodes of such a machine by map_regions(), with boundaries across `axes` as flows.
void map_onto(Bsp& bsp, nodes::TopologyKind kind, const CutAxes& axes);

/// For 2^n regions the node whose bits are the sides of the n cuts above the region, each cut's bit reversed on the high side of
/// the cut before it along the same axis: the halves of every cut mirror each other, so that on a hypercube the regions of a
/// regular lattice have their neighbours one hop away (the reflected code of F. Gray, 1953, for each axis). For other counts
/// region i on node i.
Mapping gray_mapping(const Bsp& bsp);

/// Region i on node i.
Mapping identity_mapping(std::uint32_t region_count);
/// Any permutation with equal probability, determined by `seed`: a baseline for mappings.
Mapping random_mapping(std::uint32_t region_count, std::uint64_t seed);

}  // namespace dmpc::dataflow
