// The command `study scale`: the cost of larger scenes and more nodes, and its growth.
#pragma once

#include <iosfwd>

#include "apps/frontend/line/command_line.h"
#include "apps/frontend/system/interrupt.h"
#include "apps/frontend/table/table_options.h"
#include "apps/lab/study/scale/settings.h"

namespace dmpc::apps {

struct ScaleOptions {
  ScaleSettings settings;
  TableOutput table;
  bool quiet = false;  ///< no progress
};

void add_options(OptionSet set, ScaleOptions& options);

/// Measures and writes as run_tabled() does. Throws core::UsageError for outputs that clash, core::InputError for unknown scenes
/// or outputs that cannot be made, core::CapacityError if no run had enough memory; and as measure_scale().
int study_scale_command(const ScaleOptions& options, Interrupt& interrupt, std::ostream& output);

}  // namespace dmpc::apps
