// The options for checkpoints of an unfinished picture, and for resuming from them.
#pragma once

#include <filesystem>
#include <optional>

#include "apps/frontend/line/command_line.h"

namespace dmpc::apps {

struct CheckpointOptions {
  std::optional<std::filesystem::path> file;  ///< the checkpoint, if any
  double every_seconds = 120;                 ///< wall-clock time; above 0
  bool resumes = false;                       ///< continues from the file
};

void add_options(OptionSet options, CheckpointOptions& checkpoint);

}  // namespace dmpc::apps
