// The command `bench precision`: the product's pictures in float against double precision, pixel by pixel.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "apps/command_line.h"
#include "apps/interrupt.h"
#include "apps/picture_options.h"
#include "apps/table_options.h"

namespace dmpc::apps {

struct PrecisionOptions {
  std::vector<std::string> scenes;  ///< NFF files or built-in names; none: every family in its own size
  Resolution resolution{256, 256};
  int depth = 5;
  TableOutput table;   ///< without a page and plots
  bool quiet = false;  ///< no progress
};

/// Declares them.
void add_options(OptionSet set, PrecisionOptions& options);

/// Writes the table to the file asked for (whole or not at all), else to `output`; progress goes to stderr if that is a terminal.
/// Returns the exit status: 0 if every pixel that differs is explained, 3 otherwise. Throws core::InputError for a scene that
/// cannot be read or a table that cannot be written, core::UsageError for an output that is a scene's file, and Interrupted after
/// a signal.
int bench_precision_command(const PrecisionOptions& options, Interrupt& interrupt, std::ostream& output);

}  // namespace dmpc::apps
