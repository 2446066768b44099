// The command `render`: scene in, picture and counters out.
#pragma once

#include <iosfwd>

#include "apps/image_file.h"
#include "apps/interrupt.h"
#include "apps/options.h"
#include "core/film.h"

namespace dmpc::apps {

/// Mean linear radiance of each pixel; requires samples > 0.
Image image_of(const core::Film& film, int samples);

/// Renders, writes the picture (and the counters if asked for), and prints the closing lines to `output` unless quiet; progress
/// and remarks go to stderr. What can be seen beforehand (paths, scene, memory) is checked before anything is rendered. Returns
/// the exit status 0; throws core::InputError, core::UsageError, or Interrupted, and then no picture was written.
int render_command(const RenderOptions& options, Interrupt& interrupt, std::ostream& output);

}  // namespace dmpc::apps
