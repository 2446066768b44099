// The command `study`: renders one scene on several computers and prints a table.
#pragma once

#include <iosfwd>

#include "apps/edge/system/interrupt.h"
#include "apps/lab/study/options.h"

namespace dmpc::apps {

/// Measures and writes as run_tabled() does. Throws core::InputError for a scene that cannot be read or outputs that cannot be
/// made, core::UsageError for an output that is the scene's file, core::InternalError if two runs give different films.
int study_command(const StudyOptions& options, Interrupt& interrupt, std::ostream& output);

}  // namespace dmpc::apps
