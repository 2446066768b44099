// The command `bench error`: the cost of every knob of a render, and its effect on the picture's error.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "apps/frontend/line/command_line.h"
#include "apps/frontend/system/interrupt.h"
#include "apps/frontend/table/table_options.h"
#include "apps/lab/bench/error/measure.h"

namespace dmpc::apps {

struct ErrorOptions {
  ErrorOptions();  ///< 16 samples and depth 8, replicated on as many nodes as there are cores

  std::vector<std::string> scenes;
  MeasureOptions measure;
  TableOutput table;              ///< without a page
  bool has_tessellation = false;  ///< tessellation was requested by name: a scene without tessellations is refused
  bool quiet = false;             ///< no progress
};

void add_options(OptionSet set, ErrorOptions& options);

/// Measures and writes as run_tabled() does. Throws core::UsageError for outputs that clash, core::InputError for an unsuitable
/// scene or outputs that cannot be made.
int bench_error_command(const ErrorOptions& options, Interrupt& interrupt, std::ostream& output);

}  // namespace dmpc::apps
