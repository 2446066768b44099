// The options for checkpoints of an unfinished picture, and for resuming.
#pragma once

#include <filesystem>
#include <optional>

#include "apps/frontend/line/command_line.h"

namespace dmpc::apps {

struct CheckpointOptions {
  std::optional<std::filesystem::path> file;  ///< the checkpoint; none if empty
  double every_seconds = 120;                 ///< wall clock; above 0
  bool resumes = false;                       ///< resumes from the file
};

void add_options(OptionSet options, CheckpointOptions& checkpoint);

}  // namespace dmpc::apps
