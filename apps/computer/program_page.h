// The page of --report: what a program's run, or its runs of tasks, were, came to, took and lost.
#pragma once

#include <iosfwd>

#include "apps/computer/record.h"

namespace dmpc::apps::html {

/// The whole document. Of tasks, counters are of all runs together, and what was watched is of the last one. Requires a record
/// with a view. Throws core::InputError if no temporary file can be written.
void write_program_page(const ProgramRecord& record, std::ostream& output);

}  // namespace dmpc::apps::html
