#include "apps/run/region_options.h"

#include <string>

#include "core/base/expect.h"

namespace dmpc::apps {

const char* name_of(dataflow::Balance balance) {
  using dataflow::Balance;
  return balance == Balance::subsampled   ? "subsampled"
         : balance == Balance::equal_size ? "equal-size"
         : balance == Balance::scattered  ? "scattered"
                                          : "moving";
}

const char* name_of(dataflow::CutOrder order) { return order == dataflow::CutOrder::longer_axis ? "longer-side" : "alternating"; }

void check_regions(const OptionSet& options, const dataflow::BalanceOptions& balance) {
  using dataflow::Balance;
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

}  // namespace dmpc::apps
