// The command `render`: scene in, picture and counters out.
#pragma once

#include <iosfwd>

#include "apps/image_file.h"
#include "apps/interrupt.h"
#include "apps/render_options.h"
#include "core/film.h"

namespace dmpc::apps {

/// Mean linear radiance of each pixel; requires samples > 0.
Image image_of(const core::Film& film);

/// Renders, writes the picture (and the counters if asked for), and prints the closing lines to `output`, the standard output,
/// unless quiet; progress and remarks go to stderr. What can be seen beforehand (paths, scene, memory) is checked before anything
/// is rendered, and the picture gets its name when the counters are written, too. Returns the exit status 0. Throws
/// core::UsageError or Interrupted, and then nothing was written, or core::InputError, and then no picture was written unless the
/// message says so.
int render_command(const RenderOptions& options, Interrupt& interrupt, std::ostream& output);

}  // namespace dmpc::apps
