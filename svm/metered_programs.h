// The node programs of a run with meters. In a file of their own: beside them the compiler would inline less of
// those without a meter.
#pragma once

#include "core/build/database.h"
#include "core/picture/pixel_task.h"
#include "svm/plan.h"
#include "svm/run.h"

namespace dmpc::svm {

/// Makes the programs of the plan's strategy, with our grid. Requires options.watching.is_metered(). All arguments outlive the
/// result.
MakeProgram metered_programs(const core::Database& database, const core::RenderSettings& settings, const Plan& plan,
                             const RunOptions& options);

}  // namespace dmpc::svm
