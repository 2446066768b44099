// The command `machine`: prints a machine's figures as JSON.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>

#include "apps/frontend/line/command_line.h"

namespace dmpc::apps {

struct MachineOptions {
  std::string machine;                ///< a preset's name or a machine file
  std::optional<std::uint32_t> draw;  ///< of its prices
  bool is_measured = false;           ///< with the prices of this computer
};

void add_options(OptionSet options, MachineOptions& machine);

/// Prints to `output`, the standard output. Returns the exit status 0. Throws core::InputError as load_machine() does, or if
/// writing fails.
int machine_command(const MachineOptions& options, std::ostream& output);

}  // namespace dmpc::apps
