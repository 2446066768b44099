// The command `bench speed`: compares our grid, pictures, emulated computers and databases with Embree and with each other.
#pragma once

#include <iosfwd>
#include <set>

#include "apps/frontend/line/command_line.h"
#include "apps/frontend/system/interrupt.h"
#include "apps/frontend/table/table_options.h"
#include "apps/lab/bench/speed/part.h"

namespace dmpc::apps {

struct SpeedOptions {
  SpeedSettings settings;
  bool is_ablation = false;  ///< then ablation is the only part
  std::set<SpeedPart> parts = all_speed_parts();
  bool shows_all = false;  ///< all means, not only the main ones
  TableOutput table;       ///< without a page and plots
  bool quiet = false;      ///< no progress
};

void add_options(OptionSet set, SpeedOptions& options);

/// Measures part by part and writes as run_tabled() does; the exit status does not depend on the figures. Throws core::UsageError
/// for outputs that clash, core::InputError for an unsuitable scene or outputs that cannot be made.
int bench_speed_command(const SpeedOptions& options, Interrupt& interrupt, std::ostream& output);

}  // namespace dmpc::apps
