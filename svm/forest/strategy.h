// The strategy by which questions travel: J. Goldsmith and J. Salmon's, over one tree of boxes.
#pragma once

#include <cstdint>
#include <stop_token>

#include "core/database/database.h"
#include "core/picture/pixel_task.h"
#include "svm/run.h"
#include "svm/strategy.h"

namespace dmpc::svm {

/// Pixels that a node has under way unless asked otherwise: a quarter of its share of the picture, within these. One whose pixel
/// waits for an answer has others to go on with, and the more there are, the fuller are packets of questions; but what is under
/// way cannot be given to an idle node (svm/RESULTS.md).
inline constexpr std::uint32_t forest_in_flight_least = 16, forest_in_flight_most = 256;

/// Every node holds the upper part of the tree, and asks the owners of its subtrees what rays meet there.
const Strategy* forest_strategy();

/// Renders with strategy forest, a database of one tree in spatial order (core::Database::forest_page_count()), as run_by() does.
Report run_forest(const core::Database& database, const core::RenderSettings& settings, const RunOptions& options,
                  std::stop_token stop);

}  // namespace dmpc::svm
