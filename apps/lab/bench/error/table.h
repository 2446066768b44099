// The results of `bench error` as a table, and plots of it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "apps/frontend/table/plot.h"
#include "apps/frontend/table/table.h"
#include "apps/lab/bench/error/result.h"

namespace dmpc::apps {

/// Returns the rows of all measured points, in their order. The Pareto fronts are those of the scene's points whose error is
/// claimed. Errors are in 8-bit steps, 1/255, of linear light.
Table table_of(std::span<const SceneResult> results, const std::string& title);

/// Returns the claimed rows of one scene, from which its plots are drawn.
Table plotted_table(const SceneResult& result);

/// Returns RMSE against seconds and against rays, named after `name`: a curve for each knob, and the Pareto front.
std::vector<Plot> plots_of(const SceneResult& result, const std::string& name);

}  // namespace dmpc::apps
