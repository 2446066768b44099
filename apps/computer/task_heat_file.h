// What each task of a run took, as a file.
#pragma once

#include <cstdint>
#include <iosfwd>

#include "apps/computer/record.h"

namespace dmpc::apps {

/// As CSV, a line a task. What adds up over tasks is called like the counter of --stats that it adds up to, as far as there is
/// one; operations are the program's, and computing is empty on threads. Of the last run.
void write_task_heat(const ProgramRecord& record, std::ostream& output);

}  // namespace dmpc::apps
