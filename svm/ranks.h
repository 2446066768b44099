// A run on several ranks: what rank 0, which alone has the scene, sends the others, and what they do with it.
#pragma once

#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "core/database/database.h"
#include "core/picture/pixel_task.h"
#include "nodes/ranks/rank_links.h"
#include "nodes/ranks/repeated_runs.h"
#include "svm/pages/observers/reference_log.h"
#include "svm/plan.h"
#include "svm/strategy.h"

namespace dmpc::svm {

/// On rank 0, before its own nodes are made: sends each other rank its job, what is to be observed there and, node by node, the
/// pages that its programs keep. Returns when all have their nodes. `are_frames`: these are kept, for nodes::hand_out_again() of
/// settings before another picture. Throws what fails on another rank.
void hand_out(const Plan& plan, const core::RenderSettings& settings, const core::Database& database,
              const std::string& observer_order, bool are_frames, nodes::RankLinks& links);

/// A worker rank's callbacks for a run of these strategies.
struct WorkerCallbacks : nodes::WorkerCallbacks {
  /// Strategies that the run may have.
  Strategies strategies = {svm_strategy(), replicated_strategy()};
  /// Called after watch(): where references are to be recorded, by node; nullptr if they are not.
  std::function<std::vector<ReferenceLog>*()> reference_logs = [] { return nullptr; };
};

/// Runs a worker rank while rank 0 renders by run_by(), with one of its strategies. Of the scene only its nodes' pages are in its
/// memory. With several frames it goes on with the next, or with new nodes, until rank 0 ends: throws nodes::Dismissed then, and
/// as run_by() does.
nodes::WorkerOutcome follow(nodes::RankLinks& links, std::stop_token stop, const WorkerCallbacks& callbacks = {});

}  // namespace dmpc::svm
