// The command `scene`: writes a built-in scene as NFF.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>

#include "apps/frontend/line/command_line.h"
#include "apps/frontend/system/interrupt.h"

namespace dmpc::apps {

struct SceneOptions {
  std::string name;                             ///< a built-in scene that NFF can have
  std::optional<std::filesystem::path> output;  ///< stdout if not given
  bool quiet = false;                           ///< as of all commands; this one prints nothing else
};

void add_options(OptionSet options, SceneOptions& scene);

/// Writes to the requested file (atomically), else to `output`. A signal ends the process. Returns the exit status 0. Throws
/// core::InputError for an unknown name or if writing fails; core::UsageError for a landscape or grove, and if -o ends in
/// anything but .nff; Interrupted if a signal arrived before.
int scene_command(const SceneOptions& options, Interrupt& interrupt, std::ostream& output);

}  // namespace dmpc::apps
