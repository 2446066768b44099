// The options that keep a picture under way, and go on with one.
#pragma once

#include <filesystem>
#include <optional>

#include "apps/frontend/line/command_line.h"

namespace dmpc::apps {

struct CheckpointOptions {
  std::optional<std::filesystem::path> file;  ///< where what is done is kept; without it nothing is
  double every_seconds = 120;                 ///< wall clock; above 0
  bool resumes = false;                       ///< goes on from what the file has
};

/// Declares them.
void add_options(OptionSet options, CheckpointOptions& checkpoint);

}  // namespace dmpc::apps
