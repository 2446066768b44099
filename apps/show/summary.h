// The closing lines of a render on the terminal.
#pragma once

#include <iosfwd>

#include "apps/run/render_record.h"

namespace dmpc::apps {

/// A few lines: the scene, the computer and its memory by category, its ranks if it has some, rays, what the strategy is about
/// (pages; or travel, load and regions), virtual time and its parts if a machine was modelled, times by the wall clock, the
/// picture and its film's hash.
void print_summary(std::ostream& output, const RenderRecord& record);

}  // namespace dmpc::apps
