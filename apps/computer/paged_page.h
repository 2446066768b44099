// The page of --report: what the runs of a program of tasks were, came to, took and lost.
#pragma once

#include <iosfwd>

#include "apps/computer/paged_record.h"

namespace dmpc::apps::html {

/// The whole document: counters are of all runs together, what was watched is of the last one. Requires a record with a view.
/// Throws core::InputError if no temporary file can be written.
void write_paged_page(const PagedRecord& record, std::ostream& output);

}  // namespace dmpc::apps::html
