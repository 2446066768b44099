// The results of the study `scale`: a table with the growth of each figure, and pictures.
#pragma once

#include <string>
#include <vector>

#include "apps/frontend/table/plot.h"
#include "apps/frontend/table/table.h"
#include "apps/lab/study/scale/measure.h"
#include "apps/lab/study/scale/settings.h"

namespace dmpc::apps {

/// Returns a row for each result; below them, for each family and method, and for each method on growing numbers of nodes, the
/// exponents with which the figures grow, over all rows and, if there are more than three, over the last three; and notes that
/// say the same in words.
Table scale_table(const std::vector<ScaleResult>& results, const ScaleSettings& settings);

/// Returns the results' rows alone.
Table scale_rows(const std::vector<ScaleResult>& results, const ScaleSettings& settings);

/// Returns the conclusion from such a table's rows: how the first method's time and memory grow with the scene, and its time with
/// the nodes; empty if there are too few rows.
std::string scale_conclusion(const Table& table);

/// Returns pictures of such a table, logarithmic on both axes.
std::vector<Plot> scale_plots(const ScaleSettings& settings);

}  // namespace dmpc::apps
