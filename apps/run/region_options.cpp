#include "apps/run/region_options.h"

#include <string>

#include "core/base/expect.h"

namespace dmpc::apps {

namespace {

/// Columns of loads in 128 MiB.
constexpr std::int64_t columns_per_side_max = 4096;
/// No picture has a longer side.
constexpr std::int64_t subsample_max = 65536;

}  // namespace

const char* name_of(dataflow::Balance balance) {
  using dataflow::Balance;
  return balance == Balance::subsampled   ? "subsampled"
         : balance == Balance::equal_size ? "equal-size"
         : balance == Balance::scattered  ? "scattered"
                                          : "moving";
}

void add_balance_option(OptionSet options, dataflow::Balance& balance) {
  using dataflow::Balance;
  options.add_choice<Balance>(
      "--balance", balance,
      {{"subsampled", Balance::subsampled},
       {"equal-size", Balance::equal_size},
       {"scattered", Balance::scattered},
       {"moving", Balance::moving}},
      "Regions of about equal load, by a subsampled picture, or of equal size, or scattered: a lattice of many regions a node, "
      "neighbours on different nodes; or moving: subsampled, of several units that nodes hand over while rays travel");
}

const char* name_of(dataflow::CutOrder order) { return order == dataflow::CutOrder::longer_axis ? "longer-side" : "alternating"; }

void add_cuts_option(OptionSet options, dataflow::CutOrder& order) {
  using dataflow::CutOrder;
  options.add_choice<CutOrder>("--cuts", order, {{"longer-side", CutOrder::longer_axis}, {"alternating", CutOrder::alternating}},
                               "Which way space is cut next: across a box's longer side, or by turns as in 1994");
}

void add_scattered_option(OptionSet options, dataflow::BalanceOptions& balance) {
  options.add_number("--regions", balance.regions_a_node, 1, dataflow::Scattered::regions_max, "1",
                     "Regions a node (--balance=scattered), or units of a node's region (--balance=moving)");
}

void add_region_options(OptionSet options, dataflow::BalanceOptions& balance) {
  options.add_number("--subsample", balance.subsample, 1, subsample_max, "8",
                     "The subsampled picture has one pixel of every NxN");
  options.add_number("--balance-grid", balance.columns_per_side, 1, columns_per_side_max, "256",
                     "Columns a side in which the load is counted");
}

void check_regions(const OptionSet& options, const dataflow::BalanceOptions& balance) {
  using dataflow::Balance;
  for (const char* const option : {"--subsample", "--balance-grid"}) {
    if (options.is_given(option) && !balance.is_by_load()) {
      throw core::UsageError(std::string(option) +
                             " goes with --balance=subsampled or moving: regions of equal size ask for no load");
    }
  }
  if (options.is_given("--regions") && !balance.has_several_regions()) {
    throw core::UsageError("--regions goes with --balance=scattered or moving: else a node has one region");
  }
  if (balance.balance == Balance::moving && balance.regions_a_node < 2) {
    throw core::UsageError("--balance=moving needs --regions=K, from 2 units a node on, such as 16");
  }
  if (options.is_given("--cuts") && balance.balance == Balance::scattered) {
    throw core::UsageError("--cuts does not go with --balance=scattered: a lattice is not cut box by box");
  }
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
