// The figures of `bench error` as a table, and as plots of it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "apps/frontend/table/plot.h"
#include "apps/frontend/table/table.h"
#include "apps/lab/bench/error/result.h"

namespace dmpc::apps {

/// The rows of all points that are measured, in their order. The Pareto fronts are those of the scene's points whose error is
/// claimed. Errors are in 8-bit steps, 1/255, of linear light.
Table table_of(std::span<const SceneResult> results, const std::string& title);

/// The claimed rows of one scene, which its plots are drawn from.
Table plotted_table(const SceneResult& result);

/// RMSE against seconds and against rays, named after `name`: a curve a knob, and the Pareto front.
std::vector<Plot> plots_of(const SceneResult& result, const std::string& name);

}  // namespace dmpc::apps
