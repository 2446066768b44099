// The choice of strategy: from the options to a run that is ready to start.
#pragma once

#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "apps/run/report.h"
#include "apps/run/strategy_options.h"
#include "core/database/database.h"
#include "core/picture/film/partial_picture.h"
#include "core/picture/pixel_task.h"
#include "nodes/observers/watching.h"

namespace dmpc::apps {

/// A planned run; for dataflow also balanced and assigned.
struct ReadyRun {
  std::vector<std::string> notes;  ///< notes for the user before the run: sentences
  /// Renders. Throws core::InputError if the real computer has too little memory or too few threads, and core::InternalError if a
  /// conservation check fails.
  std::function<Report(const nodes::Progress&, std::stop_token)> start;
  /// After start(), if the options have several frames: renders the next on the same nodes, with the progress of start().
  /// `settings` may differ from those of the first in the camera and what depends on it only. Throws as start() does. Empty with
  /// another tracer than our own.
  std::function<Report(const core::RenderSettings& settings, std::stop_token)> go_on;
};

/// Reads the machine to be modelled, if there is one, and uses its topology for the mapping of regions. Throws core::InputError
/// as load_machine() does.
void choose_machine(StrategyOptions& options);
/// Chooses this machine, unchanged.
void choose_machine(StrategyOptions& options, const nodes::Machine& machine);

/// Requires options after choose_machine(). For dataflow it renders the subsampled picture, cut short once a stop is requested:
/// then the result is usable only for a run that the same stop ends at once. `database` and `settings` outlive the result. The
/// distribution of the database may be reported to `watching` before the start; its progress is that of the start. Throws
/// core::UsageError for options that the strategy does not take, core::InputError if the nodes' memory is too small, with
/// sufficient sizes. No node's memory is allocated before the start.
ReadyRun make_ready(const StrategyOptions& options, const core::Database& database, const core::RenderSettings& settings,
                    const std::stop_token& stop = {}, const nodes::Watching& watching = {},
                    const core::Continuation& continuation = {});

}  // namespace dmpc::apps
