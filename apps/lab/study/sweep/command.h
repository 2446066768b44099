// The command `study sweep`: one scene with all combinations of any options of `render`, and the requested figures.
#pragma once

#include <iosfwd>
#include <map>
#include <string>

#include "apps/frontend/line/command_line.h"
#include "apps/frontend/system/interrupt.h"
#include "apps/frontend/table/table_options.h"
#include "apps/lab/study/sweep/settings.h"

namespace dmpc::apps {

struct StudySweepOptions {
  SweepSettings settings;
  std::map<std::string, bool> flags;  ///< of `render`, by name: set by the line
  TableOutput table;
  bool quiet = false;  ///< no progress
};

/// Declares its own options and all options of `render` that determine how it renders.
void add_options(OptionSet set, StudySweepOptions& options);

/// Measures and writes as run_tabled() does. Throws core::UsageError for a combination that `render` would not take,
/// core::InputError for bad input, core::CapacityError if no run had enough memory.
int study_sweep_command(const StudySweepOptions& options, Interrupt& interrupt, std::ostream& output);

}  // namespace dmpc::apps
