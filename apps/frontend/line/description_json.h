// What a command line declares, as JSON, for the scripts that write manuals.
#pragma once

#include <string>

#include "apps/frontend/line/command_description.h"

namespace dmpc::apps {

/// An object with the program, its version and its exit statuses; members have the names of CommandDescription's.
std::string description_json(const CommandDescription& program, const std::string& version);

}  // namespace dmpc::apps
