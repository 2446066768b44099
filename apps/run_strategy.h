// The choice of strategy: from the options to a run that is ready to start.
#pragma once

#include <cstdint>
#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "apps/render_options.h"
#include "apps/report.h"
#include "core/database.h"
#include "core/pixel_task.h"

namespace dmpc::apps {

/// Told (pixels that are done, or have light, and pixels in all) on the host's thread.
using RunProgress = std::function<void(std::uint32_t, std::uint32_t)>;

/// Everything is planned and, for dataflow, balanced and dealt.
struct ReadyRun {
  std::vector<std::string> notes;  ///< what the user should know before: sentences
  /// Renders. Throws core::InternalError if a law of conservation is broken.
  std::function<Report(const RunProgress&, std::stop_token)> start;
};

/// The options with the machine that is modelled, if one is: read, with its links as asked for, and its topology as that onto
/// which regions are mapped. Throws core::InputError as load_machine() does.
RenderOptions with_machine(RenderOptions options);
/// The same with this machine as it is.
RenderOptions with_machine(RenderOptions options, const nodes::Machine& machine);

/// The options are such as with_machine() returns, or ask for threads. For dataflow it renders the subsampled picture. All
/// arguments outlive the result. Throws core::UsageError for options that the strategy does not take, core::InputError if the
/// nodes' memory is too small, naming what works.
ReadyRun make_ready(const RenderOptions& options, const core::Database& database, const core::RenderSettings& settings);

}  // namespace dmpc::apps
