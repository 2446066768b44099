// The choice of strategy: from the options to a run that is ready to start.
#pragma once

#include <cstdint>
#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "apps/run/report.h"
#include "apps/run/strategy_options.h"
#include "core/build/database.h"
#include "core/picture/partial_picture.h"
#include "core/picture/pixel_task.h"
#include "nodes/observer.h"
#include "nodes/watch/heat_map.h"

namespace dmpc::apps {

/// Told (pixels that are done, or have light, and pixels in all) on the host's thread.
using RunProgress = std::function<void(std::uint32_t, std::uint32_t)>;

/// What ties a run to those who want more of it than a picture. Everything pointed to outlives it.
struct RunTies {
  /// If given, the run starts at most once, and this is called when it will not read the database's records again: before the
  /// start, or when it starts.
  std::function<void()> distributed = {};
  nodes::HeatMap* heat = nullptr;                            ///< what each pixel takes is added to it; of the picture's size
  nodes::Observer* observer = nullptr;                       ///< sees the run happen
  std::vector<svm::ReferenceLog>* reference_logs = nullptr;  ///< as svm::RunOptions has them
  core::Continuation continuation = {};                      ///< where the run begins, and what is kept of it
};

/// Everything is planned and, for dataflow, balanced and dealt.
struct ReadyRun {
  std::vector<std::string> notes;  ///< what the user should know before: sentences
  /// Renders. Throws core::InputError if the real computer has too little memory or too few threads, and core::InternalError if a
  /// law of conservation is broken.
  std::function<Report(const RunProgress&, std::stop_token)> start;
};

/// Reads the machine that is to be modelled, if one is: with its links and ports as asked for, and its topology as that onto
/// which regions are mapped; without contention there are no ports. Throws core::InputError as load_machine() does, and
/// core::UsageError for memory ports that are asked for on a machine whose file has no contention.
void choose_machine(StrategyOptions& options);
/// The same with this machine as it is.
void choose_machine(StrategyOptions& options, const nodes::Machine& machine);

/// The options are such as choose_machine() leaves them. For dataflow it renders the subsampled picture, in haste once a stop is
/// requested: then the result is good for a run that the same stop ends at once. `database` and `settings` outlive the result.
/// Throws core::UsageError for options that the strategy does not take, core::InputError if the nodes' memory is too small,
/// naming what works. No memory of a node is asked of the real computer before the start.
ReadyRun make_ready(const StrategyOptions& options, const core::Database& database, const core::RenderSettings& settings,
                    const std::stop_token& stop = {}, const RunTies& ties = {});

}  // namespace dmpc::apps
