// How a command's table is asked for.
#pragma once

#include "apps/command_line.h"
#include "apps/study_table.h"

namespace dmpc::apps {

/// Declares --format.
void add_format_option(OptionSet options, TableFormat& format);

}  // namespace dmpc::apps
