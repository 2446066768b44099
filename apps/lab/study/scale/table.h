// What the study `scale` finds, as a table with the growth of each of its figures, and as pictures.
#pragma once

#include <string>
#include <vector>

#include "apps/frontend/table/plot.h"
#include "apps/frontend/table/table.h"
#include "apps/lab/study/scale/measure.h"
#include "apps/lab/study/scale/settings.h"

namespace dmpc::apps {

/// A row for each result; below them, for each family and method, and for each method on more and more nodes, the exponents with
/// which the figures grow, over all rows and, where there are more than three, over the last three; and notes that say the same
/// in words.
Table scale_table(const std::vector<ScaleResult>& results, const ScaleSettings& settings);

/// The results' rows alone.
Table scale_rows(const std::vector<ScaleResult>& results, const ScaleSettings& settings);

/// What such a table comes to, from its rows: how the first method's time and memory grow with the scene, and its time with the
/// nodes; empty if they tell too little.
std::string scale_conclusion(const Table& table);

/// Pictures of such a table, logarithmic on both axes.
std::vector<Plot> scale_plots(const ScaleSettings& settings);

}  // namespace dmpc::apps
