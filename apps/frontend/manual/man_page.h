// The manual page dmpc(1).
#pragma once

#include <string>

#include "apps/frontend/line/command_description.h"

namespace dmpc::apps {

/// The page, written from what is declared: every command once, and every option once, with the first command that has it in the
/// same words; the commands after that refer to it. `version` is the program's name and version, "dmpc 0.1.0".
std::string man_page(const CommandDescription& program, const std::string& version);

}  // namespace dmpc::apps
