// The command `machine`: prints a machine's figures as JSON.
#pragma once

#include <iosfwd>
#include <string>

#include "apps/frontend/line/command_line.h"

namespace dmpc::apps {

struct MachineOptions {
  std::string machine;  ///< a preset's name or a machine file
};

void add_options(OptionSet options, MachineOptions& machine);

/// Prints to `output`, the standard output. Returns the exit status 0. Throws core::InputError as load_machine() does, or if
/// writing fails.
int machine_command(const MachineOptions& options, std::ostream& output);

}  // namespace dmpc::apps
