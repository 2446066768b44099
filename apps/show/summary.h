// The closing lines of a render on the terminal.
#pragma once

#include <iosfwd>

#include "apps/run/render_record.h"

namespace dmpc::apps {

/// Prints a few lines: the scene, the computer and its memory by category, its ranks if there are any, rays, the strategy's main
/// figures (pages; or travel, load and regions), virtual time and its parts on a modelled machine, wall clock times, the picture
/// and its film's hash, and advice if there is any.
void print_summary(std::ostream& output, const RenderRecord& record);

}  // namespace dmpc::apps
