// Closing advice: options with which a run like this one takes less processor time.
#pragma once

#include <cstdint>
#include <string>

#include "apps/run/render_options.h"
#include "apps/run/strategy_options.h"
#include "svm/run.h"

namespace dmpc::apps {

/// Returns whole lines on a finished run of strategy svm on so many processors, by default those of this computer; usually none,
/// and none on modelled machines, on ranks and for published systems.
std::string advice_lines(const RenderOptions& options, const svm::Report& report,
                         std::uint32_t processors = nodes::processors_allowed());

}  // namespace dmpc::apps
