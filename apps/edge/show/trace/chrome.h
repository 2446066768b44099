// Writes a trace as JSON, in the event format of Chrome's tracing, which Perfetto reads, too.
#pragma once

#include <iosfwd>

#include "apps/edge/show/trace/view.h"

namespace dmpc::apps {

/// Each node is a process with one thread: what it does are slices (X), those of interrupts within others; messages are flows (s,
/// f) from slice to slice; the wait for a page is an asynchronous slice (b, e); levels are counters (C). Times are microseconds
/// with three decimals. All events are in order of time, and a message's beginning
/// before its end. One line each. Equal traces, equal bytes.
void write_chrome(const TraceView& view, std::ostream& output);

}  // namespace dmpc::apps
