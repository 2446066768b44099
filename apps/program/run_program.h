// The one way from a command line to an exit status.
//   0 done    1 bad input    2 wrong usage    3 an internal check failed    4 not enough memory    5 differs    130 interrupted
#pragma once

#include <span>
#include <string>

#include "apps/program/commands.h"

namespace dmpc::apps {

/// The command that the arguments ask for, without the program's name; throws core::UsageError.
using Parse = Command (*)(std::span<const std::string> arguments);

/// Reads the command line, calls one command, and turns what went wrong into a line on stderr and the status, which it returns.
int run_program(Parse parse, int count, char** values);

}  // namespace dmpc::apps
