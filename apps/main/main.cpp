// dmpc: renders by itself, and passes other commands on to the laboratory's program, which knows all.

#include <unistd.h>

#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/frontend/system/companion_path.h"
#include "apps/main/allocation.h"
#include "apps/program/run_program.h"
#include "core/base/expect.h"

namespace dmpc::apps {

namespace {

/// Throws InstallationError if it is not there.
std::filesystem::path laboratory() {
  return companion_path("dmpc_lab", "../libexec/dmpc", "the program dmpc_lab, which has the laboratory's commands,");
}

Command parse_renderer_line(std::span<const std::string> arguments) {
  try {
    return parse_command_line(declare_renderer, arguments);
  } catch (const core::UsageError& error) {
    try {
      static_cast<void>(laboratory());
    } catch (const InstallationError& missing) {  // it might have understood
      throw core::UsageError(std::string(error.what()) + "\n" + missing.what());
    }
    throw;
  }
}

/// Help covers all commands, and a wrong line may be meant for another program.
bool is_for_renderer(std::span<const std::string> arguments) {
  try {
    return !parse_command_line(declare_renderer, arguments).asks_for_help();
  } catch (const core::UsageError&) {
    return false;
  }
}

/// Returns if there is nothing to pass on, or no program. Errors here recur where they can be reported.
void hand_on(int count, char** values) {
  try {
    if (!is_for_renderer(std::vector<std::string>(values + 1, values + count))) {
      ::execv(laboratory().c_str(), values);
    }
  } catch (const std::exception&) {
  }
}

}  // namespace

}  // namespace dmpc::apps

int main(int count, char** values) {
  dmpc::apps::keep_freed_memory();
  dmpc::apps::hand_on(count, values);
  return dmpc::apps::run_program(dmpc::apps::parse_renderer_line, count, values);
}
