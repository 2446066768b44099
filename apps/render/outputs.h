// The files that a render leaves.
#pragma once

#include "apps/frontend/system/output_set.h"
#include "apps/run/render_record.h"

namespace dmpc::apps {

/// All outputs; of the picture and the checkpoint it has the names alone: they are written when it is their time.
OutputSet<RenderRecord> outputs_of(const RenderOptions& options);

/// Throws core::InputError unless what the options ask for can be written, as far as can be known beforehand, and none of it
/// falls on the scene or the machine's file.
void check_outputs(const RenderOptions& options, const OutputSet<RenderRecord>& outputs);

/// Counters that were asked for on the standard output go there with the closing lines, and not into a file.
bool has_counters_on_standard_output(const RenderOptions& options);

}  // namespace dmpc::apps
