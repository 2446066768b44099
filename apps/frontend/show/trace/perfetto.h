// Writes a trace in Perfetto's own format (https://perfetto.dev, protos/perfetto/trace), which ui.perfetto.dev and its
// trace_processor read, with times in whole nanoseconds.
#pragma once

#include <filesystem>
#include <iosfwd>

#include "apps/frontend/show/trace/view.h"

namespace dmpc::apps {

/// Throws core::UsageError for a file whose extension is not .pftrace; for another format's extension the message names a
/// converter.
void check_trace_path(const std::filesystem::path& path);

/// Each node is a process with a thread. Its slices are the node's activities; instants joined by flows are the two ends of a
/// message. Each level has a track, and overlapping waits have one each. The process "run" has general data of the run, and which
/// times were recorded if not all were. Packets are in order of time, and a message's beginning precedes its end; texts are
/// converted to UTF-8. Equal traces give equal bytes.
void write_perfetto(const TraceView& view, std::ostream& output);

}  // namespace dmpc::apps
