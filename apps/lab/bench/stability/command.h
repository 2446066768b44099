// The command `bench stability`: stress tests of numerical stability, with Embree on the same rays.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "apps/frontend/line/command_line.h"
#include "apps/frontend/system/interrupt.h"
#include "apps/frontend/table/table_options.h"

namespace dmpc::apps {

struct StabilityOptions {
  static constexpr std::uint64_t standard_rays = 100'000, quick_rays = 10'000;

  std::uint64_t rays = standard_rays;   ///< for each row of the table; 0: each test's number of the long run
  bool quick = false, is_long = false;  ///< the command line's words for quick_rays and 0; `rays` has the value
  std::vector<std::string> tests;       ///< "R1", "quadrics"; none: all
  std::uint64_t seed = 1;
  TableOutput table;   ///< without a page and plots
  bool quiet = false;  ///< no progress
};

void add_options(OptionSet set, StabilityOptions& options);

/// Measures and writes as run_tabled() does. The exit status is also 1 if one of our kernels failed, whatever Embree did. Throws
/// core::UsageError for an unknown test, core::InputError for a table that cannot be made.
int bench_stability_command(const StabilityOptions& options, Interrupt& interrupt, std::ostream& output);

}  // namespace dmpc::apps
