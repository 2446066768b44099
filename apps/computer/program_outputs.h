// What a run of a program leaves: files, and what is printed.
#pragma once

#include <iosfwd>

#include "apps/computer/options.h"
#include "apps/computer/record.h"
#include "apps/frontend/system/output_set.h"

namespace dmpc::apps {

/// As CSV, a line a task. What adds up over tasks is called like the counter of --stats that it adds up to, as far as there is
/// one; operations are the program's, and computing is empty on threads. Of the last run.
void write_task_heat(const ProgramRecord& record, std::ostream& output);

using ProgramOutputs = OutputSet<ProgramRecord>;

/// The files that are asked for.
ProgramOutputs outputs_of(const ProgramOptions& options);

/// Throws as check_outputs() of names does, and core::InputError if a report is asked for and the plots of its page could not be
/// drawn for want of a temporary folder.
void check_outputs(const ProgramOptions& options, const ProgramOutputs& outputs);

/// Writes the files, and prints what the program came to and, unless asked not to, its closing lines. Returns the exit status.
int end_program(const ProgramRecord& record, const ProgramOutputs& outputs);

}  // namespace dmpc::apps
