// Writes a trace in the format of Paje (L. Schnorr and others, "Pajé trace file format"), whose header describes its own events.
#pragma once

#include <iosfwd>

#include "apps/edge/show/trace/view.h"

namespace dmpc::apps {

/// Each node is a container with a stack of states, what it does; messages are links; levels are variables. What takes no time is
/// left out, since a state without duration is none. Times are seconds with nine decimals, and never decrease. Equal traces,
/// equal bytes.
void write_paje(const TraceView& view, std::ostream& output);

}  // namespace dmpc::apps
