// The contents of the --trace file.
#pragma once

#include <iosfwd>
#include <string>

#include "apps/run/render_record.h"

namespace dmpc::apps {

/// Writes the trace in the form that the record's options request. Requires that they request one, and that the record has one.
void write_trace(const RenderRecord& record, std::ostream& stream);

/// Returns a sentence on what was lost of a trace, and how to avoid that; empty if nothing was lost.
std::string loss_note(const nodes::Trace& trace);
/// Returns a sentence if a trace has no activity or message; else empty.
std::string empty_note(const nodes::Trace& trace);

}  // namespace dmpc::apps
