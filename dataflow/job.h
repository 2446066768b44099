// What a rank without the host is told of a run before it has parts of the scene: all but these.
#pragma once

#include <string>
#include <string_view>

#include "core/database/extract.h"
#include "core/picture/pixel_task.h"
#include "dataflow/plan.h"
#include "dataflow/regions/regions.h"
#include "nodes/ranks/rank_links.h"

namespace dmpc::dataflow {

/// What the programs of all nodes are made of.
struct Job {
  Plan plan;
  core::RenderSettings settings;
  Regions regions;
  core::DatabasePart outline;  ///< its header and bytes alone
  bool are_frames = false;     ///< others may follow it on the same nodes
};

/// As bytes.
std::string job_bytes(const Plan& plan, const core::RenderSettings& settings, const Regions& regions,
                      const core::DatabasePart& outline, bool are_frames);
/// From these, on a rank, which makes the plan anew and expects it to be the same.
Job job_from(std::string_view bytes, nodes::RankLinks& ranks);

}  // namespace dmpc::dataflow
