// The closing lines of a render on the terminal.
#pragma once

#include <iosfwd>

#include "apps/stats.h"

namespace dmpc::apps {

/// A few lines: the picture, the computer and its memory by category, rays, pages, times, and the film's hash.
void print_summary(std::ostream& output, const RenderRecord& record);

}  // namespace dmpc::apps
