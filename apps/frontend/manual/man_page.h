// The manual page dmpc(1).
#pragma once

#include <string>

#include "apps/frontend/line/command_description.h"

namespace dmpc::apps {

/// Writes the page from the declarations: every command once, and every option once, with the first command that describes it in
/// the same words; later commands refer to it. `version` is the program's name and version, "dmpc 0.1.0".
std::string man_page(const CommandDescription& program, const std::string& version);

}  // namespace dmpc::apps
