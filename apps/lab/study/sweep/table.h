// The results of a sweep as a table and its pictures.
#pragma once

#include <string>
#include <vector>

#include "apps/frontend/table/plot.h"
#include "apps/frontend/table/table.h"
#include "apps/lab/study/sweep/measure.h"
#include "apps/lab/study/sweep/settings.h"

namespace dmpc::apps {

/// Returns the names of the table's figures: the requested ones, or those useful for the runners and strategies of the runs.
std::vector<std::string> figures_of(const SweepSettings& settings, const std::vector<SweepRun>& runs);

/// Returns a row for each result: the values of the variations, as numbers if all are numbers or sizes (in bytes), and the
/// figures. Missing figures are empty; notes say why some runs had not enough memory.
Table sweep_table(const SweepSettings& settings, const std::vector<SweepRun>& runs, const std::vector<SweepResult>& results);

/// Returns a picture for each numeric figure: over the first numeric variation, with a curve for each combination of the rest, or
/// bars; none for more curves than can be distinguished.
std::vector<Plot> sweep_plots(const SweepSettings& settings, const std::vector<SweepRun>& runs);

}  // namespace dmpc::apps
