// The options --trace and --trace-window: whether and what of a run is recorded, and where it goes.
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

/// A window of a run in nanoseconds since its start; `to_ns` is not included, and without it the end of the run.
struct TraceWindow {
  std::uint64_t from_ns = 0;
  std::optional<std::uint64_t> to_ns;
};

struct TraceOptions {
  std::optional<std::filesystem::path> path;  ///< .pftrace; without it nothing is recorded
  std::optional<TraceWindow> window;
};

/// "FROM,TO" in milliseconds; either may be left out. Throws core::UsageError for anything else, or an empty window.
TraceWindow parse_trace_window(const std::string& text);

/// Declares them.
void add_options(OptionSet options, TraceOptions& trace);

/// Throws core::UsageError for a window without --trace, and a file that is none of Perfetto's.
void check_trace(const TraceOptions& trace);

/// What a recorder is to record.
nodes::TraceChoice trace_choice(const TraceOptions& trace);

}  // namespace dmpc::apps
