#include "apps/region_options.h"

namespace dmpc::apps {

namespace {

/// Columns of loads in 128 MiB.
constexpr std::int64_t columns_per_side_max = 4096;
/// No picture has a longer side.
constexpr std::int64_t subsample_max = 65536;

}  // namespace

void add_region_options(OptionSet options, dataflow::BalanceOptions& balance) {
  options.add_number("--subsample", balance.subsample, 1, subsample_max, "8",
                     "The subsampled picture has one pixel of every NxN");
  options.add_number("--balance-grid", balance.columns_per_side, 1, columns_per_side_max, "256",
                     "Columns a side in which the load is counted");
}

void add_topology_option(OptionSet options, nodes::TopologyKind& topology) {
  using nodes::TopologyKind;
  OptionSet::Choices<TopologyKind> topologies;
  for (const auto kind :
       {TopologyKind::hypercube, TopologyKind::mesh, TopologyKind::torus, TopologyKind::fat_tree, TopologyKind::crossbar}) {
    topologies.emplace_back(name_of(kind), kind);
  }
  options.add_choice("--topology", topology, topologies, "The wiring onto which neighbouring regions are mapped");
}

}  // namespace dmpc::apps
