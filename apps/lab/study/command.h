// The command `study`: renders one scene on several computers and prints a table.
#pragma once

#include <iosfwd>

#include "apps/edge/system/interrupt.h"
#include "apps/lab/study/options.h"

namespace dmpc::apps {

/// Writes the table to the file asked for (whole or not at all), else to `output`; progress goes to stderr if that is a terminal.
/// After a signal the table has the rows finished until then, if there are any. What cannot be written is said on
/// stderr and keeps nothing else from being written. Returns the exit status, 1 then. Throws core::InputError for a scene that
/// cannot be read or outputs that cannot be made, core::UsageError for an output that is the
/// scene's file, core::InternalError if two runs give different films, and Interrupted after a signal.
int study_command(const StudyOptions& options, Interrupt& interrupt, std::ostream& output);

}  // namespace dmpc::apps
