// The command `study scale`: what larger scenes and more nodes take, and how fast that grows.
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

/// Declares them.
void add_options(OptionSet set, ScaleOptions& options);

/// Measures and writes as run_tabled() does. Throws core::UsageError for outputs that clash, core::InputError for scenes that
/// there are not, for outputs that cannot be made, or if no run found room (core::CapacityError); and as measure_scale().
int study_scale_command(const ScaleOptions& options, Interrupt& interrupt, std::ostream& output);

}  // namespace dmpc::apps
