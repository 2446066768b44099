// What stability tests found, as a table.
#pragma once

#include <cstdint>

#include "apps/edge/table/table.h"
#include "apps/lab/bench/stability/run.h"

namespace dmpc::apps {

/// A row for each test and each kernel that it tried, in the order of the tests; notes say what the columns mean, where the
/// tests are that do not run inside the program, and what each case has tried.
Table table_of(const StabilityState& state, std::uint64_t seed);

}  // namespace dmpc::apps
