// The command `study references`: cache misses for references from a file.
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
  std::string file;                        ///< "-" is the standard input
  ReferenceColumns columns;                ///< their names in the file
  std::vector<std::uint32_t> cache_pages;  ///< sizes in pages; empty: about 12, from 1 to all pages
  std::vector<std::string> policies;       ///< other than dmpc's own, as ForeignPolicy takes them
  TableOutput table;
  bool quiet = false;  ///< no progress
};

void add_options(OptionSet set, ReferencesOptions& options);

/// Measures and writes as run_tabled() does. Throws core::UsageError for outputs that clash, core::InputError for references that
/// cannot be read and outputs that cannot be made, core::CapacityError for more references than fit memory.
int study_references_command(const ReferencesOptions& options, Interrupt& interrupt, std::ostream& output);

}  // namespace dmpc::apps
