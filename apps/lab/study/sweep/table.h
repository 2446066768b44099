// What a sweep found, as a table and its pictures.
#pragma once

#include <string>
#include <vector>

#include "apps/frontend/table/plot.h"
#include "apps/frontend/table/table.h"
#include "apps/lab/study/sweep/measure.h"
#include "apps/lab/study/sweep/settings.h"

namespace dmpc::apps {

/// Names of the figures that the table has: those asked for, or what is of use for the runners and strategies of the runs.
std::vector<std::string> figures_of(const SweepSettings& settings, const std::vector<SweepRun>& runs);

/// A row for each result: the values of what varies, which are numbers where all are numbers or sizes (in bytes), and the
/// figures. What a run does not have is empty; below stands why there was no room for some.
Table sweep_table(const SweepSettings& settings, const std::vector<SweepRun>& runs, const std::vector<SweepResult>& results);

/// A picture for each figure that is a number: over the first of what varies by numbers, with a curve for each combination of the
/// rest, or bars; none for more curves than can be told apart.
std::vector<Plot> sweep_plots(const SweepSettings& settings, const std::vector<SweepRun>& runs);

}  // namespace dmpc::apps
