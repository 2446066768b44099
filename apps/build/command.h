// The command `build`: writes a scene's database to a file, which stands for the scene from then on.
#pragma once

#include <iosfwd>

#include "apps/build/built_file.h"
#include "apps/frontend/line/command_line.h"
#include "apps/frontend/system/interrupt.h"

namespace dmpc::apps {

void add_options(OptionSet options, BuildRequest& build);

/// Writes the file as a whole or not at all. A signal ends the process. Returns the exit status 0. Throws core::InputError and
/// core::UsageError for the scene as render_command() does, and if the file cannot be written.
int build_command(const BuildRequest& build, Interrupt& interrupt, std::ostream& output);

}  // namespace dmpc::apps
