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

/// Everything is planned and, for dataflow, balanced and assigned.
struct ReadyRun {
  std::vector<std::string> notes;  ///< what the user should know before: sentences
  /// Renders. Throws core::InputError if the real computer has too little memory or too few threads, and core::InternalError if a
  /// law of conservation is broken.
  std::function<Report(const nodes::Progress&, std::stop_token)> start;
  /// After start(), where the options say that there are several frames: renders the next on the same nodes, and says how far it
  /// is as start() was told. `settings` differ from those of the first in the camera, and what follows from it, alone. Throws as
  /// start() does. Empty with a tracer other than our own.
  std::function<Report(const core::RenderSettings& settings, std::stop_token)> go_on;
};

/// Reads the machine that is to be modelled, if one is, with its topology as that onto which regions are mapped. Throws
/// core::InputError as load_machine() does.
void choose_machine(StrategyOptions& options);
/// Chooses this machine as it is.
void choose_machine(StrategyOptions& options, const nodes::Machine& machine);

/// The options are such as choose_machine() leaves them. For dataflow it renders the subsampled picture, in haste once a stop is
/// requested: then the result is good for a run that the same stop ends at once. `database` and `settings` outlive the result.
/// `watching` may be told that the database is distributed before the start, and its progress is that which the start is given.
/// Throws core::UsageError for options that the strategy does not take, core::InputError if the nodes' memory is too small,
/// naming what works. No memory of a node is asked of the real computer before the start.
ReadyRun make_ready(const StrategyOptions& options, const core::Database& database, const core::RenderSettings& settings,
                    const std::stop_token& stop = {}, const nodes::Watching& watching = {},
                    const core::Continuation& continuation = {});

}  // namespace dmpc::apps
