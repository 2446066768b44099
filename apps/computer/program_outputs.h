// The outputs of a program's run: files and printed text.
#pragma once

#include <iosfwd>

#include "apps/computer/options.h"
#include "apps/computer/record.h"
#include "apps/frontend/system/output_set.h"

namespace dmpc::apps {

/// Writes the last run as CSV, one line per task. Columns that add up over tasks are named after the --stats counter of their
/// sum, if there is one; operations are the program's, and computing is empty on threads.
void write_task_heat(const ProgramRecord& record, std::ostream& output);

using ProgramOutputs = OutputSet<ProgramRecord>;

/// Returns the requested files.
ProgramOutputs outputs_of(const ProgramOptions& options);

/// Throws as check_outputs() of names does, and core::InputError if there is no temporary folder for a requested report's plots.
void check_outputs(const ProgramOptions& options, const ProgramOutputs& outputs);

/// Writes the files, and prints the program's result and, unless quiet, its closing lines. Returns the exit status.
int end_program(const ProgramRecord& record, const ProgramOutputs& outputs);

}  // namespace dmpc::apps
