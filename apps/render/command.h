// The command `render`: renders a scene to a picture and counters.
#pragma once

#include <iosfwd>

#include "apps/frontend/system/files.h"
#include "apps/frontend/system/interrupt.h"
#include "apps/run/render_options.h"
#include "nodes/ranks/fabric.h"

namespace dmpc::apps {

/// With --runner=mpi it is called on all ranks; the first does the following, and the others contribute their nodes. Renders,
/// writes the picture, then the other outputs, and prints the closing lines to `output`, the standard output, unless quiet;
/// progress and notes go to stderr. Everything that can be checked in advance (paths, scene, memory) is checked before rendering:
/// then it throws core::UsageError or core::InputError. Outputs that cannot be written afterwards are reported on stderr, a line
/// each, and do not prevent others. Returns the exit status. Throws Interrupted, in which case no picture was written. The
/// outputs and the checkpoint are written to `files`.
int render_command(const RenderOptions& options, Interrupt& interrupt, std::ostream& output, Files& files = real_files());

/// The command on a rank of `fabric`, whose frames hold packets of payload_bytes_max(options) (apps/render/ranks.h): all ranks
/// call it with the same options, and get the same status. Only the first writes and prints. Throws nodes::LostRank if a rank is
/// lost.
int render_over(nodes::Fabric& fabric, const RenderOptions& options, Interrupt& interrupt, std::ostream& output,
                Files& files = real_files());

}  // namespace dmpc::apps
