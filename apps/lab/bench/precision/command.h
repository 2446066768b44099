// The command `bench precision`: the product's pictures in float against double precision, pixel by pixel.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "apps/frontend/line/command_line.h"
#include "apps/frontend/system/interrupt.h"
#include "apps/frontend/table/table_options.h"
#include "apps/scene/picture_options.h"

namespace dmpc::apps {

struct PrecisionOptions {
  std::vector<std::string> scenes;  ///< NFF files or built-in names; none: every family in its own size
  Resolution resolution{256, 256};
  int depth = 5;  ///< for paths, the transport's
  TransportOptions transport;
  /// Percentage of the pixels that have the same 8 bits; nothing: the usual or the measured one. The number of pixels that may
  /// differ is rounded up.
  std::optional<double> expected;
  SceneSetup scene_setup;  ///< for all scenes
  TableOutput table;       ///< without a page and plots
  bool quiet = false;      ///< no progress
};

void add_options(OptionSet set, PrecisionOptions& options);

/// Measures and writes as run_tabled() does. The exit status is 3 if a pixel that differs is not explained, or if fewer pixels
/// than expected have the same 8 bits. Throws core::InputError for a scene that cannot be read or a table that cannot be made,
/// core::UsageError for an output that is a file the scene is read from.
int bench_precision_command(const PrecisionOptions& options, Interrupt& interrupt, std::ostream& output);

/// The expected percentage of a picture's pixels that have the same 8 bits in float and in double.
struct Expectation {
  double percent = 0;
  std::string reason;  ///< why it is not higher
};

/// Returns, for a family's own scene by its name, the value measured at 256x256 pixels and depth 5 with its own view and lights,
/// in whole hundredths of a percent; for any other scene the usual 99 %.
Expectation expectation_of(const std::string& scene);

}  // namespace dmpc::apps
