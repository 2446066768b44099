// Selects the strategy and prepares a run from the options.
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
  std::vector<std::string> notes;  ///< sentences for the user, before the run
  /// Renders. Throws core::InputError for too little real memory or too few threads, core::InternalError for a failed
  /// conservation check.
  std::function<Report(const nodes::Progress&, std::stop_token)> start;
  /// Requires several frames: renders the next one on the same nodes, after start() and with its progress. `settings` may differ
  /// from the first only in the camera and what depends on it. Throws as start() does. Empty with another tracer than our own.
  std::function<Report(const core::RenderSettings& settings, std::stop_token)> go_on;
};

/// Reads the modelled machine, if any; its topology maps the regions. Throws core::InputError as load_machine() does.
void choose_machine(StrategyOptions& options);
/// Uses this machine, unchanged.
void choose_machine(StrategyOptions& options, const nodes::Machine& machine);

/// Loads the user's replacement policy, if there is one, which the options share. `check` is called while it is waited for, now
/// and in runs, and may throw. Throws core::InputError as ForeignPolicy does.
void load_policy(StrategyOptions& options, const std::function<void()>& check);

/// Requires that choose_machine() and load_policy() were called on the options. For dataflow this renders the subsampled picture,
/// which is cut short once a stop is requested; the result is then usable only for a run that the same stop ends at once.
/// `database` and `settings` outlive the result. The distribution of the database may be reported to `watching` before the start;
/// its progress is that of the start. Throws core::UsageError for options that the strategy does not accept, and
/// core::InputError, with sufficient sizes, if the nodes' memory is too small. No node's memory is allocated before the start.
ReadyRun make_ready(const StrategyOptions& options, const core::Database& database, const core::RenderSettings& settings,
                    const std::stop_token& stop = {}, const nodes::Watching& watching = {},
                    const core::Continuation& continuation = {});

}  // namespace dmpc::apps
