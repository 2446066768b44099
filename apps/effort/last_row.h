// A table's rows, shown one by one while the others are still awaited.
#pragma once

#include <iosfwd>

#include "apps/study_table.h"

namespace dmpc::apps {

/// Writes the row added last as a line over the line of progress, which is written anew below it.
void show_last_row(const Table& table, std::ostream& messages);

}  // namespace dmpc::apps
