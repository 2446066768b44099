// The command `bench precision`: the product's pictures in float against double precision, pixel by pixel.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "apps/edge/line/command_line.h"
#include "apps/edge/system/interrupt.h"
#include "apps/edge/table/table_options.h"
#include "apps/scene/picture_options.h"

namespace dmpc::apps {

struct PrecisionOptions {
  std::vector<std::string> scenes;  ///< NFF files or built-in names; none: every family in its own size
  Resolution resolution{256, 256};
  int depth = 5;
  Staging staging;     ///< of all scenes
  TableOutput table;   ///< without a page and plots
  bool quiet = false;  ///< no progress
};

/// Declares them.
void add_options(OptionSet set, PrecisionOptions& options);

/// Writes the table to the file asked for (whole or not at all), else to `output`; progress goes to stderr if that is a terminal.
/// After a signal or an error it has the scenes measured before. Returns the exit status: 3 if a pixel that differs is not
/// explained, 1 if the table could not be written, which is said on stderr, else 0. Throws core::InputError for a scene that
/// cannot be read or a table that cannot be made, core::UsageError for an output that is a file the scene is read from, and
/// Interrupted after a signal.
int bench_precision_command(const PrecisionOptions& options, Interrupt& interrupt, std::ostream& output);

}  // namespace dmpc::apps
