// The options --trace and --trace-window: whether a run is recorded, which part, and where.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "apps/frontend/line/command_line.h"

namespace dmpc::nodes {
struct TraceChoice;
}  // namespace dmpc::nodes

namespace dmpc::apps {

/// A half-open window of a run, in nanoseconds since its start; without `to_ns` it ends with the run.
struct TraceWindow {
  std::uint64_t from_ns = 0;
  std::optional<std::uint64_t> to_ns;
};

struct TraceOptions {
  std::optional<std::filesystem::path> path;  ///< .pftrace; without it nothing is recorded
  std::optional<TraceWindow> window;
};

/// Parses "FROM,TO" in milliseconds; either may be omitted. Throws core::UsageError for anything else, or an empty window.
TraceWindow parse_trace_window(const std::string& text);

void add_options(OptionSet options, TraceOptions& trace);

/// Throws core::UsageError for a window without --trace, and for a file that is not Perfetto's.
void check_trace(const TraceOptions& trace);

/// Returns what the recorder records.
nodes::TraceChoice trace_choice(const TraceOptions& trace);

}  // namespace dmpc::apps
