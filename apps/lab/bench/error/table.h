// The results of `bench error` as a table, and plots of it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "apps/frontend/table/plot.h"
#include "apps/frontend/table/table.h"
#include "apps/lab/bench/error/result.h"

namespace dmpc::apps {

/// Returns the rows of all measured points, in their order. Errors are in 8-bit steps, 1/255, of linear light; without the
/// reference's own only if it tells them (is_told()).
Table table_of(std::span<const SceneResult> results, const std::string& title);

/// Returns plots of the scene's table, errors against processor time: `name`, of uniform and adaptive sampling alone, and of the
/// other knobs, if there are any. Points that nothing beats in the same plot are marked.
std::vector<Plot> plots_of(const SceneResult& result, const std::string& name);
/// Returns the name of the second plot.
std::string knobs_plot_of(const std::string& name);

}  // namespace dmpc::apps
