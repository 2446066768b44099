// The output files of a render.
#pragma once

#include "apps/frontend/system/output_set.h"
#include "apps/run/render_record.h"

namespace dmpc::apps {

/// All outputs; the picture and the checkpoint have only names here, since they are written separately.
OutputSet<RenderRecord> outputs_of(const RenderOptions& options);

/// Throws core::InputError unless all outputs can be written, as far as can be known in advance, and none is the file of the
/// scene or the machine.
void check_outputs(const RenderOptions& options, const OutputSet<RenderRecord>& outputs);

/// Whether the counters go to the standard output, together with the closing lines, instead of a file.
bool has_counters_on_standard_output(const RenderOptions& options);

}  // namespace dmpc::apps
