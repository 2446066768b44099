// The options of a program of tasks beside those of any program: what pages and caches are like, and what is written of them.
#pragma once

#include <vector>

#include "apps/computer/options.h"

namespace dmpc::apps {

/// Declares all that such a program has, and which go together.
void add_task_options(OptionSet options, ProgramOptions& program, const std::vector<NumberOption>& own);

}  // namespace dmpc::apps
