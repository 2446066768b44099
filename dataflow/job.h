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
};

/// As bytes.
std::string job_bytes(const Plan& plan, const core::RenderSettings& settings, const Regions& regions,
                      const core::DatabasePart& outline);
/// From these, on a rank, which makes the plan anew and expects it to be the same.
Job job_from(std::string_view bytes, nodes::RankLinks& ranks);

}  // namespace dmpc::dataflow
