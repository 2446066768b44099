// What a render of several frames says of each on the terminal.
#pragma once

#include <cstdint>
#include <iosfwd>

#include "apps/run/render_record.h"

namespace dmpc::apps {

/// A line: the frame, its picture and film, what its nodes fetched, asked or sent on, all that was sent, and times.
void print_frame(std::ostream& output, std::uint64_t frame, const RenderRecord& record);

}  // namespace dmpc::apps
