// A run on several ranks: what rank 0, which alone has the scene, sends the others, and what they do with it.
#pragma once

#include <stop_token>
#include <string>

#include "core/picture/pixel_task.h"
#include "dataflow/distribution.h"
#include "dataflow/plan.h"
#include "nodes/ranks/rank_links.h"
#include "nodes/ranks/repeated_runs.h"

namespace dmpc::dataflow {

/// On rank 0, before its own nodes are made: sends each other rank its job, what is to be observed there and, node by node, their
/// assignments. Returns when all have their nodes. `are_frames`: these are kept, for nodes::hand_out_again() of settings before
/// another picture. Throws what fails on another rank.
void hand_out(const Plan& plan, const Distribution& distribution, const core::RenderSettings& settings,
              const std::string& observer_order, bool are_frames, nodes::RankLinks& links);

/// Runs a worker rank while rank 0 renders by run_prepared(). Of the scene only its nodes' parts are in its memory. With several
/// frames it goes on with the next, or with new nodes, until rank 0 ends: throws nodes::Dismissed then, and as run_prepared()
/// does.
nodes::WorkerOutcome follow(nodes::RankLinks& links, std::stop_token stop, const nodes::WorkerCallbacks& callbacks = {});

}  // namespace dmpc::dataflow
