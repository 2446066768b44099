// The calls of the module for Python, with the names and types of their options.
#pragma once

#include <string>

#include "apps/edge/line/command_description.h"

namespace dmpc::apps {

/// The files calls.py, study.py and commas.py of apps/python/dmpc: a function for each command that has one, whose keywords are
/// the command's options, so that whoever types them is offered what there is; and which values have commas between. `program`
/// has all commands.
std::string python_calls(const CommandDescription& program);
std::string python_studies(const CommandDescription& program);
std::string python_commas(const CommandDescription& program);

}  // namespace dmpc::apps
