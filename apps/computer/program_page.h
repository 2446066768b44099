// The page of --report: what a run of a program with packets was, came to, took and lost.
#pragma once

#include <iosfwd>

#include "apps/computer/record.h"

namespace dmpc::apps::html {

/// The whole document. Requires a record with a view. Throws core::InputError if no temporary file can be written.
void write_program_page(const ProgramRecord& record, std::ostream& output);

}  // namespace dmpc::apps::html
