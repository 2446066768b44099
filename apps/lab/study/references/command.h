// The command `study references`: what caches would miss of references that a file has.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "apps/frontend/line/command_line.h"
#include "apps/frontend/show/references/reference_file.h"
#include "apps/frontend/system/interrupt.h"
#include "apps/frontend/table/table_options.h"

namespace dmpc::apps {

struct ReferencesOptions {
  std::string file;                        ///< "-": the standard input
  ReferenceColumns columns;                ///< what those of the file are called
  std::vector<std::uint32_t> cache_pages;  ///< sizes in pages; empty: about 12, from 1 to all pages
  std::vector<std::string> policies;       ///< that are not dmpc's own, as ForeignPolicy takes them
  TableOutput table;
  bool quiet = false;  ///< no progress
};

/// Declares them.
void add_options(OptionSet set, ReferencesOptions& options);

/// Measures and writes as run_tabled() does. Throws core::UsageError for outputs that clash, core::InputError for references that
/// cannot be read and outputs that cannot be made, core::CapacityError for more than there is memory for.
int study_references_command(const ReferencesOptions& options, Interrupt& interrupt, std::ostream& output);

}  // namespace dmpc::apps
