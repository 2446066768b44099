// The options --trace and --trace-...: whether and what of a run is recorded, and where it goes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/edge/line/command_line.h"

namespace dmpc::nodes {
struct TraceChoice;
enum class TraceKeep : std::uint8_t;
}  // namespace dmpc::nodes

namespace dmpc::apps {

/// A window of a run in nanoseconds since its start; `to_ns` is not included, and without it the end of the run.
struct TraceWindow {
  std::uint64_t from_ns = 0;
  std::optional<std::uint64_t> to_ns;
};

/// Some of the nodes: pairs of the first and the last of a row of them, and perhaps the host.
struct TraceNodes {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> rows;
  bool has_host = false;
};

struct TraceOptions {
  std::optional<std::filesystem::path> path;  ///< as trace_file_of() says; without it nothing is recorded
  std::optional<TraceWindow> window;
  std::optional<TraceNodes> nodes;
  std::uint32_t every = 1;               ///< pixels of which one is recorded
  std::uint32_t events_max = 1'000'000;  ///< that are kept
  nodes::TraceKeep keep = {};            ///< of more than these: by default of the whole run
};

/// "FROM,TO" in milliseconds; either may be left out. Throws core::UsageError for anything else, or an empty window.
TraceWindow parse_trace_window(const std::string& text);
/// "0,3-5,host". Throws core::UsageError for anything else.
TraceNodes parse_trace_nodes(const std::string& text);

/// Declares them.
void add_options(OptionSet options, TraceOptions& trace);

/// Throws core::UsageError for what is given without --trace, an ending that is no format, or a node that there is not.
void check_trace(const OptionSet& options, const TraceOptions& trace, std::uint32_t node_count);

/// What a recorder is to record of so many nodes and the host.
nodes::TraceChoice trace_choice(const TraceOptions& trace, std::uint32_t node_count);

}  // namespace dmpc::apps
