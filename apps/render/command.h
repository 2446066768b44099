// The command `render`: scene in, picture and counters out.
#pragma once

#include <iosfwd>

#include "apps/frontend/system/files.h"
#include "apps/frontend/system/interrupt.h"
#include "apps/run/render_options.h"
#include "nodes/ranks/fabric.h"

namespace dmpc::apps {

/// With --runner=mpi it is to be called on all ranks, of which the first does what follows and the others lend it their nodes.
/// Renders, writes the picture, then all else that is asked for, and prints the closing lines to `output`, the standard output,
/// unless quiet; progress and remarks go to stderr. What can be seen beforehand (paths, scene, memory) is checked before anything
/// is rendered: then it throws core::UsageError or core::InputError. What cannot be written afterwards is said on stderr, a line
/// each, and keeps nothing else from being written. Returns the exit status. Throws Interrupted, and then no picture was written.
/// `files` are those that the outputs and the checkpoint are written to.
int render_command(const RenderOptions& options, Interrupt& interrupt, std::ostream& output, Files& files = real_files());

/// What it does on a rank of `fabric`, whose frames hold packets of payload_bytes_max(options) (apps/render/ranks.h): all ranks
/// call it with the same options, and get the same status. Others than the first write and print nothing. Throws nodes::LostRank
/// if a rank is lost.
int render_over(nodes::Fabric& fabric, const RenderOptions& options, Interrupt& interrupt, std::ostream& output,
                Files& files = real_files());

}  // namespace dmpc::apps
