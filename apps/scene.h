// The command `scene`: writes a built-in scene as NFF.
#pragma once

#include <iosfwd>

#include "apps/interrupt.h"
#include "apps/options.h"

namespace dmpc::apps {

/// Writes to the file asked for (whole or not at all), else to `output`. A signal ends the process. Returns the exit status 0.
/// Throws core::InputError for an unknown name or if writing fails, Interrupted if a signal came before.
int scene_command(const SceneOptions& options, Interrupt& interrupt, std::ostream& output);

}  // namespace dmpc::apps
