// The command `bench speed`: our grid, pictures, emulated computers and databases beside Embree and each other.
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
  bool is_ablation = false;  ///< then that is the only part
  std::set<SpeedPart> parts = all_speed_parts();
  TableOutput table;   ///< without a page and plots
  bool quiet = false;  ///< no progress
};

/// Declares them.
void add_options(OptionSet set, SpeedOptions& options);

/// Measures part by part and writes as run_tabled() does; the exit status does not hang on the figures. Throws core::UsageError
/// for outputs that clash, core::InputError for a scene that will not do or outputs that cannot be made.
int bench_speed_command(const SpeedOptions& options, Interrupt& interrupt, std::ostream& output);

}  // namespace dmpc::apps
