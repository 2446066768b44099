// Writes a trace in Perfetto's own format (https://perfetto.dev, protos/perfetto/trace), which ui.perfetto.dev and its
// trace_processor read, with times in whole nanoseconds.
#pragma once

#include <filesystem>
#include <iosfwd>

#include "apps/frontend/show/trace/view.h"

namespace dmpc::apps {

/// Throws core::UsageError for a file whose ending is another than .pftrace; where it is another format's it says what converts.
void check_trace_path(const std::filesystem::path& path);

/// Each node is a process with a thread, whose slices are what it does and whose instants, joined by flows, are both ends of
/// messages, with a track for each level and as many for waits as lie over each other; the process "run" has what there is to say
/// of the run, and which times were recorded, if not all. Packets are in order of time, and a message's beginning before its end;
/// texts are UTF-8, whatever they were. Equal traces, equal bytes.
void write_perfetto(const TraceView& view, std::ostream& output);

}  // namespace dmpc::apps
