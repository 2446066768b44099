// What stands in the file of --trace.
#pragma once

#include <iosfwd>
#include <string>

#include "apps/run/render_record.h"
#include "apps/run/trace_options.h"

namespace dmpc::apps {

/// What the record's options ask for of its trace. Requires that they do, and that it has one.
void write_trace(const RenderRecord& record, std::ostream& stream);

/// A sentence on what was lost of a trace, and what leaves room; empty if nothing was lost.
std::string loss_note(const nodes::Trace& trace);
/// A sentence on a trace without any activity or message; else empty.
std::string empty_note(const nodes::Trace& trace);

}  // namespace dmpc::apps
