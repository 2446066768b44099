// A plot as a page's script (plot.js) and Python (dmpc.plotting) draw it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/frontend/line/amount.h"
#include "apps/frontend/table/plot.h"
#include "apps/frontend/table/table.h"

namespace dmpc::apps {

/// Returns JSON; nothing if no row of the table is drawn. Keys:
///
/// - title, bars, stacked, width (of bars along x; 0: they stand at places)
/// - x, y: {label, unit, digits, log, least, most, ticks: [[position, text]]}; places: names along x in place of limits and ticks
/// - series: [{name, color, mark, unit, digits, rows}]; a row: x, or the number of its place, y, and for bands the
///   ends of whiskers and box; studies in Python have intervals, too, with two ends
std::optional<std::string> plot_data(const Plot& plot, const Table& table);

/// Returns [[position, text]].
nlohmann::json json_of(const std::vector<Tick>& ticks);

}  // namespace dmpc::apps
